//! Damages as files meet them: cut short, single bytes, words and numbers changed, a piece missing or there twice.

use antumbra_math::hash::{hash2, hash3};

/// Words that programs trip over: large and negative counts, infinities, NaN, denormals.
const WORDS: [u32; 8] = [0, 1, 0xffff_ffff, 0x7fff_ffff, 0x8000_0000, 0x7f80_0000, 0x7fc0_0000, 0x0000_0001];

/// What stands in place of a number of a text.
const NUMBERS: [&str; 14] = [
    "-1",
    "0",
    "1",
    "2",
    "255",
    "65536",
    "1000000000",
    "4294967295",
    "18446744073709551616",
    "1e999",
    "-1e30",
    "2.5",
    "nan",
    "x",
];

/// The numbers of one damage.
struct Draws {
    file: u32,
    round: u32,
    next: u32,
}

impl Draws {
    fn below(&mut self, n: usize) -> usize {
        self.next += 1;
        hash3(self.file, self.round, self.next) as usize % n.max(1)
    }

    /// A place in the file; half of them near its beginning, where headers are.
    fn place(&mut self, length: usize) -> usize {
        let reach = if self.below(2) == 0 { length } else { length.min(2000) };
        self.below(reach)
    }
}

/// Damage `round` of a file; `file` is any number that goes with it.
pub fn damage(bytes: &[u8], file: u32, round: u32) -> Vec<u8> {
    let mut draws = Draws { file, round, next: 0 };
    let mut out = bytes.to_vec();
    if out.is_empty() {
        return vec![hash2(file, round) as u8];
    }
    // Each kind comes at least once in five rounds.
    match round % 5 {
        0 => out.truncate(draws.below(bytes.len())),
        1 => change_bytes(&mut out, &mut draws),
        2 => change_numbers(&mut out, &mut draws),
        3 => change_words(&mut out, &mut draws),
        _ => move_a_piece(&mut out, &mut draws),
    }
    out
}

fn change_bytes(out: &mut [u8], draws: &mut Draws) {
    for _ in 0..1 + draws.below(4) {
        let at = draws.place(out.len());
        out[at] = [0xff, 0, b'9', b'-', b'"', draws.below(256) as u8][draws.below(6)];
    }
}

fn change_words(out: &mut [u8], draws: &mut Draws) {
    for _ in 0..1 + draws.below(2) {
        let at = draws.place(out.len().saturating_sub(3)) & !3;
        let word = WORDS[draws.below(WORDS.len())];
        let bytes = if draws.below(4) == 0 { word.to_be_bytes() } else { word.to_le_bytes() };
        if let Some(place) = out.get_mut(at..at + 4) {
            place.copy_from_slice(&bytes);
        }
    }
}

/// Other numbers in a text; in a GLB of the same length, so that its chunks stay where they are.
fn change_numbers(out: &mut Vec<u8>, draws: &mut Draws) {
    let keep = out.starts_with(b"glTF");
    for _ in 0..1 + draws.below(2) {
        let from = draws.place(out.len());
        let Some(start) = out[from..].iter().position(u8::is_ascii_digit).map(|n| from + n) else { continue };
        let part = |b: &u8| b.is_ascii_digit() || matches!(b, b'.' | b'-' | b'+' | b'e' | b'E');
        let length = out[start..].iter().position(|b| !part(b)).unwrap_or(out.len() - start);
        let mut number = NUMBERS[draws.below(NUMBERS.len())].as_bytes().to_vec();
        if keep {
            number.resize(length, b' ');
        }
        out.splice(start..start + length, number);
    }
}

fn move_a_piece(out: &mut Vec<u8>, draws: &mut Draws) {
    let from = draws.place(out.len());
    let length = (1 + draws.below(200)).min(out.len() - from);
    let piece: Vec<u8> = out[from..from + length].to_vec();
    match draws.below(3) {
        0 => drop(out.drain(from..from + length)),
        1 => {
            let to = draws.place(out.len());
            out.splice(to..to, piece);
        }
        _ => {
            let to = draws.place(out.len() - length);
            out[to..to + length].copy_from_slice(&piece);
        }
    }
}
