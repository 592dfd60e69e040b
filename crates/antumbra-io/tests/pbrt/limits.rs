//! Files that ask for too much: refused with their file and line, before they take it.

use std::collections::HashMap;
use std::io::Write;

use antumbra_io::{Format, Limits, MemoryFiles, read};

/// The message for a scene of some files.
fn said(text: &str, files: &[(&str, Vec<u8>)], limits: &Limits) -> String {
    let files = files.iter().map(|(name, bytes)| (name.to_string(), bytes.clone()));
    let files = MemoryFiles(HashMap::from_iter(files));
    let e = read(Format::Pbrt, text.as_bytes(), &files, limits).unwrap_err();
    format!("{}: {}", e.place, e.what)
}

/// Twenty files that name the next one twice each would be a million spheres.
#[test]
fn files_that_double_each_other_end() {
    let name = |i: usize| format!("{i}.pbrt");
    let twice = |i: usize| format!("Include \"{0}\"\nInclude \"{0}\"\n", name(i + 1)).into_bytes();
    let mut files: Vec<_> = (0..20).map(|i| (name(i), twice(i))).collect();
    files.push((name(20), b"Shape \"sphere\"".to_vec()));
    let files: Vec<_> = files.iter().map(|(name, bytes)| (name.as_str(), bytes.clone())).collect();
    let told = said("WorldBegin Include \"0.pbrt\"", &files, &Limits::default());
    assert!(told.contains(".pbrt, line ") && told.contains("again and again"), "{told}");
}

#[test]
fn a_packed_file_of_blanks_is_not_unpacked_whole() {
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
    packed.write_all(&vec![b' '; 1 << 22]).unwrap();
    let limits = Limits { expansion_base: 1 << 20, ..Limits::default() };
    let files = [("a.gz", packed.finish().unwrap())];
    let told = said("WorldBegin\nInclude \"a.gz\"", &files, &limits);
    assert!(told.starts_with("line 2: the file \"a.gz\": unpacked it has more than"), "{told}");
}

/// One packed line of an object, a million times: text is in proportion to what people write, this is not.
#[test]
fn packed_shapes_stay_in_proportion() {
    let mut packed = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
    packed.write_all(&b"Shape \"sphere\"\n".repeat(1 << 16)).unwrap();
    let limits = Limits { expansion_base: 1 << 20, ..Limits::default() };
    let files = [("a.gz", packed.finish().unwrap())];
    let told = said("WorldBegin Include \"a.gz\"", &files, &limits);
    assert!(told.starts_with("a.gz, line ") && told.contains("out of proportion"), "{told}");
}

#[test]
fn no_file_outside_the_folder_is_opened() {
    for (directive, why) in [
        ("Include \"../up.pbrt\"", "the path leaves the folder of the scene"),
        ("Import \"a/../../up.pbrt\"", "the path leaves the folder of the scene"),
        ("Include \"/etc/passwd\"", "the path is absolute"),
        ("Include \"C:/scene.pbrt\"", "the path is absolute"),
        ("Include \"http://a.b/c.pbrt\"", "addresses are never followed"),
    ] {
        let told = said(&format!("WorldBegin\n\n{directive}"), &[], &Limits::default());
        assert!(told.starts_with("line 3: the file ") && told.contains(why), "{told}");
    }
}

#[test]
fn defaults_and_attributes_have_an_end() {
    let many: String = (0..300).map(|i| format!("Attribute \"shape\" \"float a{i}\" 1\n")).collect();
    let told = said(&format!("WorldBegin\n{many}"), &[], &Limits::default());
    assert!(told.starts_with("line 258: ") && told.contains("more than 256 parameters"), "{told}");
    let deep = "AttributeBegin\n".repeat(5000);
    let told = said(&format!("WorldBegin\n{deep}"), &[], &Limits::default());
    assert!(told.contains("AttributeBegin more than 4096 deep"), "{told}");
}
