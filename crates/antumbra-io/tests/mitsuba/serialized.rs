//! Mitsuba's packed meshes, made here.

use std::io::Write;

use antumbra::scene::Mesh;
use flate2::{Compression, write::ZlibEncoder};

use crate::with;

/// Corners of a quarter of a square, turned up.
pub const CORNERS: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.5]];
const FACES: [[u32; 3]; 2] = [[0, 1, 2], [2, 1, 3]];

fn zlib(bytes: &[u8]) -> Vec<u8> {
    let mut packer = ZlibEncoder::new(Vec::new(), Compression::fast());
    packer.write_all(bytes).unwrap();
    packer.finish().unwrap()
}

/// A mesh `scale` times as large, with texture coordinates, and its corners as colours.
pub fn packed(version: u16, double: bool, scale: f32) -> Vec<u8> {
    let flags: u32 = 0xa | if double { 0x2000 } else { 0x1000 };
    let mut body = flags.to_le_bytes().to_vec();
    if version == 4 {
        body.extend_from_slice(b"fold\0");
    }
    let counts = [CORNERS.len() as u64, FACES.len() as u64];
    counts.iter().for_each(|n| body.extend(n.to_le_bytes()));
    let uvs = CORNERS.iter().flat_map(|c| [c[0], c[1]]);
    let colors = CORNERS.iter().flatten().copied();
    for x in CORNERS.iter().flatten().map(|x| x * scale).chain(uvs).chain(colors) {
        match double {
            true => body.extend(f64::from(x).to_le_bytes()),
            false => body.extend(x.to_le_bytes()),
        }
    }
    FACES.iter().flatten().for_each(|i| body.extend(i.to_le_bytes()));
    [0x041cu16, version].iter().flat_map(|n| n.to_le_bytes()).chain(zlib(&body)).collect()
}

/// Meshes one behind the other, with the list of their places.
fn file(version: u16, meshes: &[Vec<u8>]) -> Vec<u8> {
    let mut places = Vec::new();
    let mut bytes = Vec::new();
    for mesh in meshes {
        let at = bytes.len() as u64;
        places.extend_from_slice(&at.to_le_bytes()[..if version == 4 { 8 } else { 4 }]);
        bytes.extend_from_slice(mesh);
    }
    bytes.extend(places);
    bytes.extend((meshes.len() as u32).to_le_bytes());
    bytes
}

fn read(bytes: Vec<u8>, more: &str) -> Result<Mesh, String> {
    let shape =
        format!("<shape type='serialized'><string name='filename' value='a.serialized'/>{more}</shape>");
    let scene = with(&shape, &[("a.serialized", bytes)]).map_err(|e| format!("{}: {}", e.place, e.what))?;
    Ok(scene.meshes[0].clone())
}

#[test]
fn every_version_and_width_is_the_same_mesh() {
    for (version, double) in [(3, false), (3, true), (4, false), (4, true)] {
        let meshes = [1.0, 2.0, 4.0].map(|scale| packed(version, double, scale));
        let bytes = file(version, &meshes);
        for (index, scale) in [(0, 1.0), (1, 2.0), (2, 4.0)] {
            let mesh =
                read(bytes.clone(), &format!("<integer name='shape_index' value='{index}'/>")).unwrap();
            assert_eq!(mesh.triangles.vertices, CORNERS.map(|c| c.map(|x| x * scale)));
            assert_eq!(mesh.triangles.indices, FACES);
            assert_eq!(mesh.uvs[0].as_deref().unwrap()[3], [1.0, 1.0]);
            // Smooth where neither the file nor the scene says otherwise.
            assert!(mesh.normals.is_some());
        }
        let flat = read(bytes.clone(), "<boolean name='face_normals' value='true'/>").unwrap();
        assert!(flat.normals.is_none());
        let said = read(bytes, "<integer name='shape_index' value='3'/>").unwrap_err();
        assert!(said.contains("a.serialized: mesh 3: there is no such mesh: the file has 3"), "{said}");
    }
    // A file of one mesh may end without the list.
    assert!(read(packed(4, false, 1.0), "").is_ok());
}

/// Cut anywhere, with any byte changed, packed from nothing: a message or a mesh.
#[test]
fn broken_files_say_so() {
    let whole = file(4, &[packed(4, false, 1.0), packed(4, true, 1.0)]);
    let second = "<integer name='shape_index' value='1'/>";
    for length in 0..whole.len() {
        let _ = read(whole[..length].to_vec(), "");
        assert!(read(whole[..length].to_vec(), second).is_err());
    }
    for i in 0..whole.len() {
        let mut bytes = whole.clone();
        bytes[i] ^= 0x55;
        let _ = (read(bytes.clone(), ""), read(bytes, second));
    }
    let head = |version: u16| [0x041cu16, version].iter().flat_map(|n| n.to_le_bytes()).collect::<Vec<u8>>();
    assert!(read(head(5), "").unwrap_err().contains("version 5"));
    assert!(read(b"ply\n".to_vec(), "").unwrap_err().contains("does not begin like a mesh of Mitsuba"));
    let of = |vertices: u64, faces: u64, rest: &[u8]| {
        let mut body = 0x1000u32.to_le_bytes().to_vec();
        [vertices, faces].iter().for_each(|n| body.extend(n.to_le_bytes()));
        body.extend_from_slice(rest);
        head(3).into_iter().chain(zlib(&body)).collect::<Vec<u8>>()
    };
    // Counts that nothing stands behind, and zeros that unpack to very much.
    let bomb = vec![0; 100 << 20];
    for bytes in [of(u64::MAX, 1, &[]), of(1 << 40, 1, &[]), of(1, u64::MAX, &[0; 12]), of(8 << 20, 1, &bomb)]
    {
        assert!(read(bytes, "").unwrap_err().contains("out of proportion"));
    }
    assert!(read(of(1 << 20, 1, &[]), "").unwrap_err().contains("cannot be unpacked"));
    let outside = [[0u8; 12].as_slice(), &7u32.to_le_bytes(), &[0; 8]].concat();
    assert!(read(of(1, 1, &outside), "").unwrap_err().contains("names vertex 7 of 1"));
}
