//! How long readers take against reading the bytes: a PLY of 10⁶ triangles, a GLB of 100 MB, the same field as text and STL,
//! warm page cache.
//!
//! `cargo bench --profile demo -p antumbra-io --bench reading`; `ANTUMBRA_DETAIL` scales the files, `ANTUMBRA_ROUNDS`
//! says how often each is read, `ANTUMBRA_RESULT` names a JSON file for the times.

use std::fs;
use std::path::Path;
use std::time::Instant;

use antumbra::scene::{Body, SceneBuilder};
use antumbra_io::{Format, Limits, MemoryFiles, read};

/// A field of (n + 1)² vertices.
fn vertices(n: u32) -> impl Iterator<Item = [f32; 3]> {
    let height = |x: u32, z: u32| ((x * 7 + z * 13) % 31) as f32 * 0.01;
    (0..=n).flat_map(move |z| (0..=n).map(move |x| [x as f32, height(x, z), z as f32]))
}

/// Its 2 n² triangles.
fn triangles(n: u32) -> impl Iterator<Item = [u32; 3]> {
    (0..n * n * 2).map(move |i| {
        let (x, z) = (i / 2 % n, i / 2 / n);
        let a = z * (n + 1) + x;
        if i % 2 == 0 { [a, a + n + 1, a + 1] } else { [a + 1, a + n + 1, a + n + 2] }
    })
}

fn ply(n: u32) -> Vec<u8> {
    let mut out = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\n\
         property float x\nproperty float y\nproperty float z\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        (n + 1) * (n + 1),
        2 * n * n
    )
    .into_bytes();
    vertices(n).flatten().for_each(|c| out.extend(c.to_le_bytes()));
    for t in triangles(n) {
        out.push(3);
        t.iter().for_each(|i| out.extend(i.to_le_bytes()));
    }
    out
}

/// The field as rows of text: what stands before, between and behind vertices and triangles.
fn text(n: u32, [head, vertex, middle, triangle, end]: [&str; 5], base: u32) -> Vec<u8> {
    let mut out = head.to_string();
    for [x, y, z] in vertices(n) {
        // As exporters write them: six digits behind the point.
        out.push_str(&format!("{vertex}{:.6} {:.6} {:.6}\n", x * 0.123_457, y * 0.761_3, z * 0.917_3));
    }
    out.push_str(middle);
    for [a, b, c] in triangles(n) {
        out.push_str(&format!("{triangle}{} {} {}\n", a + base, b + base, c + base));
    }
    out.push_str(end);
    out.into_bytes()
}

fn ply_text(n: u32) -> Vec<u8> {
    let head = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        (n + 1) * (n + 1),
        2 * n * n
    );
    text(n, [&head, "", "", "3 ", ""], 0)
}

fn obj(n: u32) -> Vec<u8> {
    text(n, ["", "v ", "", "f ", ""], 1)
}

fn pbrt(n: u32) -> Vec<u8> {
    let head = "WorldBegin\nShape \"trianglemesh\" \"point3 P\" [\n";
    text(n, [head, "", "] \"integer indices\" [\n", "", "]\n"], 0)
}

/// The corners of each triangle.
fn corners(n: u32) -> impl Iterator<Item = [[f32; 3]; 3]> {
    let all: Vec<_> = vertices(n).collect();
    triangles(n).map(move |t| t.map(|i| all[i as usize]))
}

fn stl(n: u32) -> Vec<u8> {
    let mut out = vec![b' '; 80];
    out.extend((2 * n * n).to_le_bytes());
    for [a, b, c] in corners(n) {
        [[0.0, 1.0, 0.0], a, b, c].as_flattened().iter().for_each(|x| out.extend(x.to_le_bytes()));
        out.extend([0, 0]);
    }
    out
}

fn stl_text(n: u32) -> Vec<u8> {
    let mut out = String::from("solid field\n");
    for t in corners(n) {
        out.push_str("facet normal 0.000000 1.000000 0.000000\nouter loop\n");
        for [x, y, z] in t {
            out.push_str(&format!("vertex {:.6} {:.6} {:.6}\n", x * 0.123_457, y * 0.761_3, z * 0.917_3));
        }
        out.push_str("endloop\nendfacet\n");
    }
    out.push_str("endsolid field\n");
    out.into_bytes()
}

/// Positions, normals, texture coordinates and indices.
fn glb(n: u32) -> Vec<u8> {
    let (v, t) = ((n + 1) * (n + 1), 2 * n * n);
    let mut bin = Vec::new();
    vertices(n).flatten().for_each(|c| bin.extend(c.to_le_bytes()));
    vertices(n).for_each(|_| [0f32, 1.0, 0.0].iter().for_each(|c| bin.extend(c.to_le_bytes())));
    vertices(n).for_each(|p| [p[0], p[2]].iter().for_each(|c| bin.extend(c.to_le_bytes())));
    triangles(n).flatten().for_each(|i| bin.extend(i.to_le_bytes()));
    let parts = [
        (12 * v, v, 5126, "VEC3"),
        (12 * v, v, 5126, "VEC3"),
        (8 * v, v, 5126, "VEC2"),
        (12 * t, 3 * t, 5125, "SCALAR"),
    ];
    let (mut views, mut accessors, mut offset) = (Vec::new(), Vec::new(), 0);
    for (i, (bytes, count, component, kind)) in parts.iter().enumerate() {
        views.push(format!(r#"{{"buffer":0,"byteOffset":{offset},"byteLength":{bytes}}}"#));
        accessors.push(format!(
            r#"{{"bufferView":{i},"componentType":{component},"count":{count},"type":"{kind}"}}"#
        ));
        offset += bytes;
    }
    let mut json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"mesh":0}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}},"indices":3}}]}}],
        "accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{offset}}}]}}"#,
        accessors.join(","),
        views.join(",")
    );
    json.extend(std::iter::repeat_n(' ', (4 - json.len() % 4) % 4));
    let words =
        |out: &mut Vec<u8>, list: &[usize]| list.iter().for_each(|w| out.extend((*w as u32).to_le_bytes()));
    let mut out = b"glTF".to_vec();
    words(&mut out, &[2, 28 + json.len() + bin.len(), json.len()]);
    out.extend(b"JSON");
    out.extend(json.as_bytes());
    words(&mut out, &[bin.len()]);
    out.extend(b"BIN\0");
    out.extend(bin);
    out
}

/// Time [s] of some work; dropping what it made does not count.
fn timed<T>(work: impl FnOnce() -> T) -> f64 {
    let begin = Instant::now();
    let out = work();
    let took = begin.elapsed().as_secs_f64();
    drop(out);
    took
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted[sorted.len() / 2]
}

fn drawn(scene: &SceneBuilder) -> usize {
    let of =
        |b: &Body| if let Body::Mesh(m) = b { scene.meshes[*m as usize].triangles.indices.len() } else { 0 };
    scene.objects.iter().map(|o| of(&o.body)).sum()
}

/// Reads the bytes and makes a builder of them, in turn; returns what it found as JSON.
fn race(name: &str, format: Format, bytes: Vec<u8>, folder: &Path) -> Result<String, String> {
    let path = folder.join(name);
    fs::write(&path, &bytes).map_err(|e| e.to_string())?;
    let parse = || read(format, &bytes, &MemoryFiles::default(), &Limits::default());
    let triangles = drawn(&parse().map_err(|e| e.to_string())?);
    let (mut reading, mut building) = (Vec::new(), Vec::new());
    for _ in 0..number("ANTUMBRA_ROUNDS", 9.0) as usize {
        reading.push(timed(|| fs::read(&path)));
        building.push(timed(parse));
    }
    let ratios: Vec<f64> = building.iter().zip(&reading).map(|(b, r)| b / r).collect();
    println!(
        "{name:<14} {:>6.1} MB  {triangles:>9} triangles  bytes {:>6.1} ms  bytes → builder {:>7.1} ms  {:>6.0} MB/s  ratio {:.2}",
        bytes.len() as f64 / 1e6,
        median(&reading) * 1e3,
        median(&building) * 1e3,
        bytes.len() as f64 / 1e6 / median(&building),
        median(&ratios)
    );
    Ok(format!(
        "{{\"name\": \"{name}\", \"bytes\": {}, \"triangles\": {triangles}, \"reading\": {reading:?}, \
         \"building\": {building:?}}}",
        bytes.len()
    ))
}

/// A number from the environment.
fn number(name: &str, without: f64) -> f64 {
    std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(without)
}

/// Makes the bytes of a field of a side.
type Make = fn(u32) -> Vec<u8>;

/// Name, format, what makes its bytes, and the side of the field: about 100 MB each, but for the first.
const FILES: [(&str, Format, Make, f64); 7] = [
    ("field.ply", Format::Ply, ply, 708.0),
    ("field.glb", Format::Gltf, glb, 1336.0),
    ("field.stl", Format::Stl, stl, 1000.0),
    ("text.ply", Format::Ply, ply_text, 1150.0),
    ("text.obj", Format::Obj, obj, 1130.0),
    ("text.stl", Format::Stl, stl_text, 490.0),
    ("text.pbrt", Format::Pbrt, pbrt, 1150.0),
];

fn main() -> Result<(), String> {
    let edge = number("ANTUMBRA_DETAIL", 1.0).sqrt();
    let folder = std::env::temp_dir().join(format!("antumbra-reading-{}", std::process::id()));
    fs::create_dir_all(&folder).map_err(|e| e.to_string())?;
    let mut found = Vec::new();
    // One file after the other, so that each has the memory for itself.
    for (name, format, make, side) in FILES {
        found.push(race(name, format, make((side * edge) as u32), &folder));
    }
    fs::remove_dir_all(&folder).map_err(|e| e.to_string())?;
    let found = found.into_iter().collect::<Result<Vec<_>, _>>()?;
    match std::env::var("ANTUMBRA_RESULT") {
        Ok(file) => {
            fs::write(&file, format!("[{}]\n", found.join(",\n"))).map_err(|e| format!("{file}: {e}"))
        }
        Err(_) => Ok(()),
    }
}
