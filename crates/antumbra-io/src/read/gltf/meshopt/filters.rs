//! Filters of EXT_meshopt_compression (appendix C), undone in place. Roundings are those of the format's own library.

/// Undoes a filter over rows of `stride` bytes.
pub(super) fn undo(filter: &str, bytes: &mut [u8], stride: usize) -> Result<(), String> {
    match (filter, stride) {
        ("OCTAHEDRAL", 4) => rows(bytes, bytes_in, |v| octahedral(v, 127.0), bytes_out),
        ("OCTAHEDRAL", 8) => rows(bytes, words_in, |v| octahedral(v, 32767.0), words_out),
        ("QUATERNION", 8) => rows(bytes, words_in, quaternion, words_out),
        ("COLOR", 4) => rows(bytes, bytes_in, |v| color(v, 8), bytes_out),
        ("COLOR", 8) => rows(bytes, words_in, |v| color(v, 16), words_out),
        ("EXPONENTIAL", _) => bytes.chunks_exact_mut(4).for_each(exponential),
        ("OCTAHEDRAL" | "QUATERNION" | "COLOR", _) => {
            return Err(format!("its filter {filter} does not go with elements of {stride} bytes"));
        }
        _ => return Err(format!("its filter \"{filter}\" is unknown")),
    }
    Ok(())
}

/// Changes rows of four numbers.
fn rows<const N: usize>(
    bytes: &mut [u8],
    read: impl Fn([u8; N]) -> [i32; 4],
    change: impl Fn([i32; 4]) -> [i32; 4],
    write: impl Fn([i32; 4]) -> [u8; N],
) {
    for row in bytes.as_chunks_mut::<N>().0 {
        *row = write(change(read(*row)));
    }
}

fn bytes_in(row: [u8; 4]) -> [i32; 4] {
    row.map(|b| i32::from(b as i8))
}

fn bytes_out(v: [i32; 4]) -> [u8; 4] {
    v.map(|v| v as u8)
}

fn words_in(row: [u8; 8]) -> [i32; 4] {
    [0, 2, 4, 6].map(|i| i32::from(i16::from_le_bytes([row[i], row[i + 1]])))
}

fn words_out(v: [i32; 4]) -> [u8; 8] {
    let [a, b, c, d] = v.map(|v| (v as u16).to_le_bytes());
    [a[0], a[1], b[0], b[1], c[0], c[1], d[0], d[1]]
}

/// To the nearest whole number, halves away from zero.
fn round(x: f32) -> i32 {
    (x + if x >= 0.0 { 0.5 } else { -0.5 }) as i32
}

/// A direction on the octahedron |x| + |y| + |z| = 1, the third number being its 1; the fourth one stays.
fn octahedral([x, y, one, rest]: [i32; 4], largest: f32) -> [i32; 4] {
    let (x, y) = (x as f32, y as f32);
    let z = one as f32 - x.abs() - y.abs();
    // The lower half is folded over the edges.
    let fold = z.min(0.0);
    let x = x + if x >= 0.0 { fold } else { -fold };
    let y = y + if y >= 0.0 { fold } else { -fold };
    let s = largest / (x * x + y * y + z * z).sqrt();
    [round(x * s), round(y * s), round(z * s), rest]
}

/// Three components of a unit quaternion; the largest one follows from them, its place from the two lowest bits.
fn quaternion([x, y, z, last]: [i32; 4]) -> [i32; 4] {
    let s = std::f32::consts::FRAC_1_SQRT_2 / (last | 3) as f32;
    let [x, y, z] = [x, y, z].map(|c| c as f32 * s);
    let w = (1.0 - x * x - y * y - z * z).max(0.0).sqrt();
    let (mut out, place) = ([0; 4], (last & 3) as usize);
    for (i, c) in [w, x, y, z].into_iter().enumerate() {
        out[(place + i) % 4] = round(c * 32767.0);
    }
    out
}

/// A float as 24 bits times a power of two.
fn exponential(bytes: &mut [u8]) {
    let v = i32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
    let (power, mantissa) = (v >> 24, v << 8 >> 8);
    let scale = f32::from_bits(((power + 127) as u32) << 23);
    bytes.copy_from_slice(&(scale * mantissa as f32).to_le_bytes());
}

/// YCoCg with alpha, whose highest bit tells how many bits there are.
fn color([y, co, cg, alpha]: [i32; 4], bits: u32) -> [i32; 4] {
    let all = (1 << bits) - 1;
    let (y, alpha) = (y & all, alpha & all);
    let scale = (1i32 << (32 - alpha.leading_zeros())) - 1;
    let alpha = alpha << 1 & scale | alpha & 1;
    let s = all as f32 / scale as f32;
    [y + co - cg, y + cg, y - co - cg, alpha].map(|c| (c as f32 * s + 0.5) as i32)
}
