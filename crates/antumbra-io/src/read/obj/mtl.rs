//! MTL, the material libraries of OBJ: Kd, Ke, d and map_Kd.

use std::collections::HashMap;
use std::sync::Arc;

use antumbra::scene::{Alpha, Emission, Material, SceneBuilder, TextureId};
use antumbra::texture::{Image, Texture, Wrap};
use antumbra_math::Rgb;

use crate::read::text::{float, plain, words};
use crate::read::{Context, Counted, GREY, texels};

/// A material as its library has it.
#[derive(Clone, Default)]
struct Entry {
    kd: Option<Rgb>,
    ke: Option<Rgb>,
    d: Option<f32>,
    map_kd: Option<Map>,
}

/// A picture with where it lies on the surface.
#[derive(Clone, PartialEq)]
struct Map {
    file: String,
    offset: [f32; 2],
    scale: [f32; 2],
    clamp: bool,
}

/// The materials of all libraries of a file.
#[derive(Default)]
pub(super) struct Libraries {
    entries: HashMap<String, Entry>,
    images: HashMap<String, Option<Arc<Image>>>,
    /// A library could not be read: that its materials are unknown needs no more words.
    lost: bool,
}

impl Libraries {
    /// Reads what an `mtllib` line names: one file, or several.
    pub(super) fn load(&mut self, line: &str, context: &Context, said: &mut Counted) {
        let whole = context.files.open(line);
        let several: Vec<&str> = line.split_ascii_whitespace().collect();
        if whole.is_err() && several.len() > 1 {
            return several.iter().for_each(|name| self.load(name, context, said));
        }
        match whole {
            Ok(bytes) => self.parse(&plain(&bytes), line, said),
            Err(e) => {
                self.lost = true;
                said.warn(format!("material library \"{line}\""), format!("{e}: drawn grey"));
            }
        }
    }

    fn parse(&mut self, text: &[u8], library: &str, said: &mut Counted) {
        let mut current: Option<(String, Entry)> = None;
        for line in text.split(|b| *b == b'\n').map(|l| l.trim_ascii()) {
            let end = line.iter().position(u8::is_ascii_whitespace).unwrap_or(line.len());
            let (word, rest) = (line[..end].to_ascii_lowercase(), line[end..].trim_ascii());
            if word == b"newmtl" {
                self.entries.extend(current.take());
                current = Some((String::from_utf8_lossy(rest).into_owned(), Entry::default()));
            }
            let Some((name, entry)) = &mut current else { continue };
            let place = || format!("material \"{name}\" of {library}");
            match word.as_slice() {
                b"kd" | b"ke" => {
                    let color = color(rest);
                    if color.is_none() {
                        said.warn(place(), "a colour is not three numbers: left out");
                    }
                    *(if word == b"kd" { &mut entry.kd } else { &mut entry.ke }) = color;
                }
                b"d" => entry.d = words(rest).last().and_then(float),
                b"map_kd" => entry.map_kd = map(rest),
                b"map_ke" | b"map_d" | b"map_bump" | b"bump" | b"norm" | b"disp" | b"map_ks" => {
                    let map = String::from_utf8_lossy(&line[..end]);
                    said.warn(
                        place(),
                        format!("asks for {map}, which antumbra does not have: drawn without it"),
                    );
                }
                b"ks" if color(rest).is_some_and(|c| !c.is_black()) => {
                    said.note(place(), "its highlight (Ks) is not read: drawn diffuse");
                }
                _ => {}
            }
        }
        self.entries.extend(current);
    }

    /// The material of a name; grey if there is none, white under vertex colours.
    pub(super) fn material(
        &mut self,
        name: &str,
        colored: bool,
        context: &Context,
        scene: &mut SceneBuilder,
        said: &mut Counted,
    ) -> Material {
        let plain = Rgb::grey(if colored { 1.0 } else { GREY });
        let Some(entry) = self.entries.get(name).cloned() else {
            if !name.is_empty() && !self.lost {
                said.warn(format!("material \"{name}\""), "is in no library: drawn grey");
            }
            return Material::diffuse(plain).named(name);
        };
        let color = entry.map_kd.as_ref().and_then(|map| self.texture(map, context, scene, said));
        let albedo = entry.kd.unwrap_or(if color.is_some() { Rgb::WHITE } else { plain });
        let mut material = Material { color, ..Material::diffuse(albedo).named(name) };
        let shines = |c: &Rgb| c.is_finite() && !c.is_black() && c.0.iter().all(|c| *c >= 0.0);
        material.emission = entry.ke.filter(shines).map(|radiance| Emission { radiance, both_sides: false });
        if let Some(d) = entry.d.filter(|d| *d < 1.0) {
            (material.alpha, material.opacity) = (Alpha::Blend, d.max(0.0));
        }
        material
    }

    fn texture(
        &mut self,
        map: &Map,
        context: &Context,
        scene: &mut SceneBuilder,
        said: &mut Counted,
    ) -> Option<TextureId> {
        if !self.images.contains_key(&map.file) {
            let opened = context.files.open(&map.file).map_err(|e| e.to_string());
            let image = match opened.and_then(|bytes| texels::decode(&bytes, true, context)) {
                Ok(image) => Some(Arc::new(image)),
                Err(why) => {
                    said.warn(format!("picture \"{}\"", map.file), format!("{why}: drawn without it"));
                    None
                }
            };
            self.images.insert(map.file.clone(), image);
        }
        let image = self.images.get(&map.file)?.clone()?;
        let ([su, sv], [ou, ov]) = (map.scale, map.offset);
        // v runs upwards in OBJ, downwards in a picture.
        let wrap = [if map.clamp { Wrap::Clamp } else { Wrap::Repeat }; 2];
        Some(scene.texture(Texture { wrap, map: [su, 0.0, ou, 0.0, -sv, 1.0 - ov], ..Texture::new(image) }))
    }
}

/// r g b, or one number for all three.
fn color(rest: &[u8]) -> Option<Rgb> {
    let numbers: Option<Vec<f32>> = words(rest).map(float).collect();
    match numbers?[..] {
        [g] => Some(Rgb::grey(g)),
        [r, g, b, ..] => Some(Rgb::new(r, g, b)),
        _ => None,
    }
}

/// Options, then the name of the file, which may hold blanks.
fn map(rest: &[u8]) -> Option<Map> {
    let text = String::from_utf8_lossy(rest);
    let mut map = Map { file: String::new(), offset: [0.0; 2], scale: [1.0; 2], clamp: false };
    let mut rest = text.trim();
    while let Some((option, after)) = rest.strip_prefix('-').and_then(|r| r.split_once(char::is_whitespace)) {
        let (least, most) = match option {
            "o" | "s" | "t" => (1, 3),
            "mm" => (2, 2),
            _ => (1, 1),
        };
        let (mut numbers, mut n) = ([None; 3], 0);
        rest = after.trim_start();
        while n < most {
            let (word, after) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
            let number = word.parse::<f32>().ok();
            if n >= least && number.is_none() {
                break;
            }
            map.clamp |= option == "clamp" && word == "on";
            numbers[n] = number;
            n += 1;
            rest = after.trim_start();
        }
        let pair = |default: f32| [numbers[0].unwrap_or(default), numbers[1].unwrap_or(default)];
        match option {
            "o" => map.offset = pair(0.0),
            "s" => map.scale = pair(1.0),
            _ => {}
        }
    }
    map.file = rest.to_string();
    (!map.file.is_empty()).then_some(map)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_before_a_name_with_blanks() {
        let m = map(b"-s 2 3 -o 0.5 0.25 0 -bm 1.5 -clamp on fuze uv.jpg").unwrap();
        assert_eq!(
            (m.file.as_str(), m.scale, m.offset, m.clamp),
            ("fuze uv.jpg", [2.0, 3.0], [0.5, 0.25], true)
        );
        assert_eq!(map(b".\\SpiderTex.jpg").unwrap().file, ".\\SpiderTex.jpg");
        assert!(map(b"").is_none() && map(b"-clamp on").is_none());
    }

    #[test]
    fn one_number_is_grey() {
        assert_eq!(color(b"0.5"), Some(Rgb::grey(0.5)));
        assert_eq!(color(b"spectral a.rfl 1"), None);
    }
}
