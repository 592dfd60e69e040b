//! A scene of many plugins with damage in it: a scene or a message, never a panic. `ANTUMBRA_STRESS` asks for 100 times as
//! many damages.

use antumbra::math::hash::hash2;

use crate::serialized::packed;
use crate::{PLY, with};

const SCENE: &str = "<path value='in'/><default name='n' value='2'/><spectrum id='s' name='k' value='400:1, 500:$n 600:0.3'/>
<bsdf type='principled' id='a'><rgb name='base_color' value='.1 .2 .3'/><float name='metallic' value='0.25'/>
<float name='spec_trans' value='0.5'/><float name='sheen' value='1'/><spectrum name='specular' value='0.5'/></bsdf>
<alias id='a' as='b'/><bsdf type='blendbsdf' id='c'><ref id='b'/><bsdf type='twosided'><bsdf type='diffuse'>
<texture name='reflectance' type='mesh_attribute'><string name='name' value='vertex_color'/></texture></bsdf></bsdf></bsdf>
<shape type='shapegroup' id='g'><shape type='ply'><string name='filename' value='fold.ply'/><ref id='c'/></shape>
<shape type='sphere'><transform name='to_world'><scale value='2'/></transform></shape></shape>
<shape type='instance'><ref id='g'/><transform name='to_world'><rotate y='1' angle='30'/></transform></shape>
<shape type='merge'><shape type='serialized'><string name='filename' value='m.serialized'/><ref id='c'/>
<integer name='shape_index' value='0'/></shape></shape>
<emitter type='constant'><spectrum name='radiance' type='blackbody'><float name='temperature' value='4000'/></spectrum></emitter>
<emitter type='point'><spectrum name='intensity' type='regular'><string name='values' value='1 2 3'/></spectrum></emitter>
<emitter type='directional'><spectrum name='irradiance' type='irregular'><string name='wavelengths' value='400 500'/>
<string name='values' value='1 2'/></spectrum></emitter>
<sensor type='orthographic'><transform name='to_world'><scale value='3'/><lookat origin='0 0 9' target='0 0 0'/></transform>
</sensor>";

/// `bytes` with some of them changed, doubled, moved or gone.
fn broken(bytes: &[u8], number: u32) -> Vec<u8> {
    let mut out = bytes.to_vec();
    let at = |k: u32, below: usize| hash2(number, k) as usize % below.max(1);
    for k in 0..1 + at(0, 3) as u32 {
        let (from, length) = (at(8 * k + 1, out.len()), 1 + at(8 * k + 2, 12));
        let to = (from + length).min(out.len());
        let piece: Vec<u8> = out[from..to].to_vec();
        match at(8 * k + 3, 5) {
            0 => out[from..to].iter_mut().for_each(|b| *b = hash2(number, u32::from(*b)) as u8),
            1 => drop(out.drain(from..to)),
            2 => drop(out.splice(from..from, piece)),
            3 => out[from..to].iter_mut().filter(|b| b.is_ascii_digit()).for_each(|b| *b = b'9'),
            _ => {
                let here = at(8 * k + 4, out.len());
                drop(out.splice(here..here, piece));
            }
        }
    }
    out
}

#[test]
fn damage_ends_in_an_answer() {
    let mesh = packed(4, false, 1.0);
    let read = |scene: &[u8], ply: &[u8], mesh: &[u8]| {
        let files = [("fold.ply", ply), ("in/m.serialized", mesh)];
        with(&String::from_utf8_lossy(scene), &files)
    };
    let whole = read(SCENE.as_bytes(), PLY.as_bytes(), &mesh);
    assert_eq!(
        whole.as_ref().map(|s| (s.objects.len(), s.lights.len(), s.cameras.len())),
        Ok((3, 3, 1)),
        "{whole:?}"
    );
    let rounds = if std::env::var_os("ANTUMBRA_STRESS").is_some() { 60_000 } else { 600 };
    let (mut scenes, mut messages) = (0, 0);
    for number in 0..rounds {
        let (mut scene, mut ply, mut packed) =
            (SCENE.as_bytes().to_vec(), PLY.as_bytes().to_vec(), mesh.clone());
        match number % 6 {
            0 => ply = broken(&ply, number),
            1 => packed = broken(&packed, number),
            _ => scene = broken(&scene, number),
        }
        match read(&scene, &ply, &packed) {
            Ok(scene) => scenes += u32::from(scene.build().is_ok()),
            Err(e) => {
                assert!(!e.what.is_empty());
                messages += 1;
            }
        }
    }
    assert!(scenes > rounds / 20 && messages > rounds / 20, "{scenes} scenes, {messages} messages");
}
