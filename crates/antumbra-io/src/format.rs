//! Which format a file has.

use std::path::Path;

/// A format of scenes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// glTF 2.0, `.gltf` or `.glb`.
    Gltf,
    /// Wavefront OBJ with its MTL.
    Obj,
    /// Stanford PLY.
    Ply,
    /// STL, ASCII or binary.
    Stl,
    /// Mitsuba 3 XML.
    Mitsuba,
    /// pbrt-v4.
    Pbrt,
    /// A latitude-longitude picture, Radiance `.hdr` or OpenEXR.
    Environment,
    /// A format that is known by name and not read.
    NotRead(&'static str),
}

/// Extensions in lower case.
const EXTENSIONS: &[(&str, Format)] = &[
    ("gltf", Format::Gltf),
    ("glb", Format::Gltf),
    ("vrm", Format::Gltf),
    ("obj", Format::Obj),
    ("ply", Format::Ply),
    ("stl", Format::Stl),
    ("hdr", Format::Environment),
    ("pic", Format::Environment),
    ("exr", Format::Environment),
    ("xml", Format::Mitsuba),
    ("pbrt", Format::Pbrt),
    ("usd", Format::NotRead("USD")),
    ("usda", Format::NotRead("USD")),
    ("usdc", Format::NotRead("USD")),
    ("usdz", Format::NotRead("USD")),
    ("fbx", Format::NotRead("FBX")),
    ("blend", Format::NotRead("Blender")),
    ("dae", Format::NotRead("COLLADA")),
    ("3ds", Format::NotRead("3DS")),
    ("abc", Format::NotRead("Alembic")),
    ("off", Format::NotRead("OFF")),
    ("3mf", Format::NotRead("3MF")),
    ("ifc", Format::NotRead("IFC")),
    ("step", Format::NotRead("STEP")),
    ("stp", Format::NotRead("STEP")),
    ("x3d", Format::NotRead("X3D")),
    ("wrl", Format::NotRead("VRML")),
    ("rad", Format::NotRead("Radiance scene")),
    ("png", Format::NotRead("PNG picture")),
    ("jpg", Format::NotRead("JPEG picture")),
    ("jpeg", Format::NotRead("JPEG picture")),
];

/// First bytes, for names without a known extension.
const MAGIC: &[(&[u8], Format)] = &[
    (b"glTF", Format::Gltf),
    (b"ply\n", Format::Ply),
    (b"ply\r", Format::Ply),
    (b"#?R", Format::Environment),
    (&[0x76, 0x2f, 0x31, 0x01], Format::Environment),
    (b"solid ", Format::Stl),
    (b"PXR-USDC", Format::NotRead("USD")),
    (b"#usda", Format::NotRead("USD")),
    (b"Kaydara FBX", Format::NotRead("FBX")),
    (b"BLENDER", Format::NotRead("Blender")),
    (b"<?xml", Format::Mitsuba),
    (b"<scene", Format::Mitsuba),
];

/// The format of a file by its extension, else by its first bytes.
pub fn format_of(path: &Path, first: &[u8]) -> Option<Format> {
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    let by_name = EXTENSIONS.iter().find(|(e, _)| *e == extension);
    let by_magic = || MAGIC.iter().find(|(m, _)| first.starts_with(m)).map(|m| m.1);
    by_name.map(|e| e.1).or_else(by_magic)
}

/// The formats that are read, for messages.
pub const READS: &str = "glTF 2.0 (.gltf, .glb), OBJ, PLY, STL, Mitsuba 3 (.xml), pbrt-v4 (.pbrt), and latitude-longitude pictures (.hdr, .exr)";
