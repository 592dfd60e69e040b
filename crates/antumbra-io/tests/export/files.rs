//! Files are there whole or not at all.

use std::fs;

use antumbra_io::{is_written, write_scene};

use super::{Folder, built_in};

#[test]
fn a_scene_that_cannot_be_written_leaves_nothing_behind() {
    let folder = Folder::new("fails");
    let scene = built_in("pillars");
    // A folder lies where a mesh would have to go: the last file fails.
    let names: Vec<_> = {
        let written = super::write(&folder, "a.xml", &scene);
        written.files.iter().map(|f| f.0.clone()).collect()
    };
    for path in &names {
        fs::remove_file(path).unwrap();
    }
    fs::create_dir(names.last().unwrap()).unwrap();
    let error = write_scene(&folder.0.join("a.xml"), scene.clone(), [0.0; 3]).unwrap_err();
    assert!(error.to_string().contains("it is a folder"), "{error}");
    let left: Vec<_> = fs::read_dir(&folder.0).unwrap().map(|e| e.unwrap().file_name()).collect();
    assert_eq!(left, ["a-files"]);
    let inside = fs::read_dir(folder.0.join("a-files")).unwrap().count();
    assert_eq!(inside, 1, "only the folder that lay there");

    let error = write_scene(&folder.0.join("no/a.xml"), scene.clone(), [0.0; 3]).unwrap_err();
    assert!(error.to_string().contains("there is no folder"), "{error}");
    let error = write_scene(&folder.0.join("a.obj"), scene, [0.0; 3]).unwrap_err();
    assert!(error.to_string().contains("a scene is written as .glb"), "{error}");
    assert!(!folder.0.join("no").exists() && !is_written("a.obj".as_ref()) && is_written("A.GLB".as_ref()));
}

#[test]
fn a_scene_takes_the_place_of_an_older_file() {
    let folder = Folder::new("older");
    fs::write(folder.0.join("a.gltf"), "old").unwrap();
    let written = super::write(&folder, "a.gltf", &built_in("pillars"));
    assert_eq!(written.files.len(), 2);
    let text = fs::read_to_string(folder.0.join("a.gltf")).unwrap();
    assert!(text.starts_with('{') && text.contains("\"a.bin\""));
}
