//! Pictures come back as they were written, and appear whole or not at all.

#![allow(clippy::unwrap_used, reason = "a test may stop at the first surprise")]

use std::fs;
use std::path::PathBuf;

use antumbra_io::Limits;
use antumbra_io::picture::{
    Aov, Channels, Look, Picture, Precision, Tone, Window, check_writable, exr_bytes, png_bytes, read_exr,
    read_exr_bytes, read_picture, read_png, write_exr, write_png, write_whole,
};
use antumbra_math::hash::{hash2, unit_f32};

/// A folder of its own for one test, removed at its end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let path = std::env::temp_dir().join(format!("antumbra-io-{name}-{}", std::process::id()));
        fs::create_dir_all(&path).unwrap();
        Folder(path)
    }

    fn names(&self) -> Vec<String> {
        let names = fs::read_dir(&self.0).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap());
        names.collect()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

fn numbers(n: u32, key: u32) -> Vec<f32> {
    (0..n).map(|i| 4.0 * unit_f32(hash2(i, key)) - 1.0).collect()
}

fn three(n: u32, key: u32) -> Vec<[f32; 3]> {
    numbers(3 * n, key).chunks(3).map(|c| [c[0], c[1], c[2]]).collect()
}

fn picture(width: u32, height: u32) -> Picture {
    let n = width * height;
    let full = |name: &str, channels| Aov { name: name.into(), channels, full: true };
    Picture {
        width,
        height,
        pixels: three(n, 1),
        aovs: vec![full("albedo", Channels::Three(three(n, 2))), full("depth", Channels::One(numbers(n, 3)))],
        metadata: vec![
            ("a setting with quite a long name, longer than 31 bytes".into(), "ümläut 名前".into()),
            ("light-points".into(), "area".into()),
            ("seed".into(), "7".into()),
        ],
        window: None,
    }
}

#[test]
fn floats_come_back_bit_for_bit() {
    // Odd sizes: the last block of 16 lines is not full.
    for (width, height) in [(1, 1), (37, 35)] {
        let there = picture(width, height);
        let mut back =
            read_exr_bytes(&exr_bytes(&there, Precision::Float).unwrap(), &Limits::default()).unwrap();
        back.aovs.iter_mut().for_each(|a| a.full = true);
        assert_eq!(back, there);
    }
}

#[test]
fn halves_are_the_nearest_ones_and_full_layers_stay() {
    let mut there = picture(8, 8);
    there.pixels[0] = [1e9, -1e9, 0.1];
    let back = read_exr_bytes(&exr_bytes(&there, Precision::Half).unwrap(), &Limits::default()).unwrap();
    assert_eq!(back.pixels[0], [65504.0, -65504.0, 0.099_975_586]);
    assert_eq!(back.aovs[0].channels, there.aovs[0].channels);
    for (a, b) in back.pixels.iter().zip(&there.pixels).skip(1) {
        // Eleven significant bits: half a unit in the last place is 2⁻¹¹ of the number; 2⁻²⁵ below the normal ones.
        (0..3).for_each(|c| assert!((a[c] - b[c]).abs() <= b[c].abs() / 2048.0 + 3e-8));
    }
}

#[test]
fn a_part_of_a_picture_knows_where_it_lies() {
    let window = Some(Window { x: 5, y: 40, width: 64, height: 90 });
    let there = Picture { window, ..picture(37, 35) };
    let back = read_exr_bytes(&exr_bytes(&there, Precision::Float).unwrap(), &Limits::default()).unwrap();
    assert_eq!((back.window, back.pixels), (window, there.pixels));
}

#[test]
fn pictures_are_known_by_their_first_bytes() {
    let folder = Folder::new("kinds");
    let path = folder.0.join("picture");
    let said = |bytes: &[u8]| {
        write_whole(&path, bytes).unwrap();
        read_picture(&path)
    };
    let p = picture(4, 3);
    assert_eq!(said(&exr_bytes(&p, Precision::Float).unwrap()).unwrap().pixels, p.pixels);
    assert_eq!(said(&png_bytes(&p, &Look::default()).unwrap()).unwrap().width, 4);
    // One pixel of mantissa 128: (128 + ½)·2^(129 − 136) = 1.00390625.
    let hdr = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x80\x80\x80\x81";
    assert_eq!(said(hdr).unwrap().pixels, [[1.003_906_3; 3]]);
    let wrong = said(b"GIF89a").unwrap_err();
    assert!(wrong.file.ends_with("picture") && wrong.hint.contains("OpenEXR"), "{wrong}");
    assert!(said(b"").unwrap_err().to_string().ends_with("the file is empty (0 bytes)"));
}

#[test]
fn the_same_picture_gives_the_same_bytes() {
    let p = picture(16, 16);
    assert_eq!(exr_bytes(&p, Precision::Half).unwrap(), exr_bytes(&p, Precision::Half).unwrap());
    let look = Look::default();
    assert_eq!(png_bytes(&p, &look).unwrap(), png_bytes(&p, &look).unwrap());
}

#[test]
fn a_png_comes_back_with_its_text() {
    let folder = Folder::new("png");
    let path = folder.0.join("a.png");
    let p = picture(33, 7);
    write_png(&path, &p, &Look { exposure: -1.0, tone: Tone::Filmic }).unwrap();
    let back = read_png(&path).unwrap();
    assert_eq!((back.width, back.height), (33, 7));
    let value = |key: &str| back.metadata.iter().find(|m| m.0 == key).map(|m| m.1.clone());
    assert_eq!(value("seed").as_deref(), Some("7"));
    assert_eq!(value("exposure").as_deref(), Some("-1 EV"));
    assert!(value("tone").unwrap().contains("filmic"));
    assert_eq!(
        value("a setting with quite a long name, longer than 31 bytes").as_deref(),
        Some("ümläut 名前")
    );
    // Once quantised, always the same codes.
    let linear = Picture { metadata: Vec::new(), ..back.clone() };
    write_png(&path, &linear, &Look::default()).unwrap();
    assert_eq!(read_png(&path).unwrap().pixels, back.pixels);
    assert_eq!(folder.names(), ["a.png"]);
}

#[test]
fn what_cannot_be_written_says_why_and_leaves_nothing() {
    let folder = Folder::new("whole");
    let p = picture(2, 2);
    let missing = folder.0.join("nowhere/a.exr");
    let e = write_exr(&missing, &p, Precision::Half).unwrap_err().to_string();
    assert!(e.contains("cannot be written (there is no folder"), "{e}");
    let e = write_whole(&folder.0, b"x").unwrap_err().to_string();
    assert!(e.ends_with("cannot be written (it is a folder)"), "{e}");
    let wrong = Picture { width: 3, ..p.clone() };
    assert!(write_exr(&folder.0.join("a.exr"), &wrong, Precision::Half).is_err());
    check_writable(&folder.0.join("a.exr")).unwrap();
    assert!(folder.names().is_empty());
    assert!(check_writable(&missing).is_err());
}

#[test]
fn a_file_is_replaced_as_a_whole() {
    let folder = Folder::new("replace");
    let path = folder.0.join("a.exr");
    write_whole(&path, b"old").unwrap();
    let p = picture(4, 4);
    write_exr(&path, &p, Precision::Float).unwrap();
    assert_eq!(read_exr(&path).unwrap().pixels, p.pixels);
    assert_eq!(folder.names(), ["a.exr"]);
}

#[cfg(unix)]
#[test]
fn links_are_followed_and_devices_refused() {
    let folder = Folder::new("links");
    let (file, link) = (folder.0.join("file"), folder.0.join("link"));
    write_whole(&file, b"old").unwrap();
    std::os::unix::fs::symlink(&file, &link).unwrap();
    write_whole(&link, b"new").unwrap();
    assert_eq!(fs::read(&file).unwrap(), b"new");
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    let e = write_whole("/dev/null".as_ref(), b"x").unwrap_err().to_string();
    assert!(e.contains("not a regular file"), "{e}");
}
