//! Solid angles and irradiances against the table of closed forms (`closed_forms.json` beside the test data), which was
//! computed with 34 digits.

// A broken table should stop the test.
#![allow(clippy::unwrap_used)]

use antumbra_math::spherical::{SphericalRectangle, SphericalTriangle};
use antumbra_math::{DVec3, closed, real, solid_angle};
use serde_json::Value;

const PI: f64 = std::f64::consts::PI;

/// The table; `None` (said once) where there is none, a failure under CI.
fn table() -> Option<Value> {
    let beside = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data");
    let data = std::env::var("ANTUMBRA_DATA").unwrap_or_else(|_| beside.into());
    let path = std::path::Path::new(&data).join("../closed_forms.json");
    match std::fs::read_to_string(&path) {
        Ok(text) => Some(serde_json::from_str(&text).unwrap()),
        Err(e) => {
            assert!(std::env::var("CI").as_deref() != Ok("true"), "{}: {e}", path.display());
            println!("closed_forms: skipped, no {}", path.display());
            None
        }
    }
}

/// Every case of the rows whose id starts so, with its value.
fn cases<'a>(table: &'a Value, row: &str) -> Vec<(&'a str, &'a Value, f64)> {
    let rows = table["rows"].as_array().unwrap();
    let row = rows.iter().find(|r| r["id"] == row).unwrap();
    let cases = row["cases"].as_array().unwrap().iter();
    cases.map(|c| (c["case"].as_str().unwrap(), c, c["value_f64"].as_f64().unwrap())).collect()
}

fn number(v: &Value) -> f64 {
    v.as_f64().unwrap()
}

fn vector(v: &Value) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|i| number(&v[i])))
}

fn corners(v: &Value) -> Vec<DVec3> {
    v.as_array().unwrap().iter().map(vector).collect()
}

/// 1e-12 relative is what the table measured as reachable in f64.
fn agrees(case: &str, got: f64, value: f64, tolerance: f64) {
    assert!((got - value).abs() <= tolerance * value.abs(), "{case}: {got:e} is not {value:e}");
}

#[test]
fn solid_angles() {
    let Some(table) = table() else { return };
    for (id, case, value) in cases(&table, "CF40") {
        let (p, y) = (&case["params"], number(&case["params"]["y"]));
        let (x, z) = ([0, 1].map(|i| number(&p["x"][i])), [0, 1].map(|i| number(&p["z"][i])));
        let (u, v) = (DVec3::X * (x[1] - x[0]), DVec3::Z * (z[1] - z[0]));
        let corner = DVec3::new(x[0], y, z[0]);
        // Seen from over their length, the ends of c and f are opposite up to 10⁻⁶: of the sum of their unit vectors
        // 2⁻⁵³/10⁻⁶ is left.
        let tolerance = if id == "CF40c" || id == "CF40f" { 1e-10 } else { 1e-12 };
        agrees(id, solid_angle::parallelogram(corner, u, v), value, tolerance);
        // Sampling keeps six digits or hands over to two triangles.
        let two = [(corner, corner + u, corner + u + v), (corner, corner + u + v, corner + v)];
        let sum: f64 =
            two.iter().filter_map(|t| SphericalTriangle::new(t.0, t.1, t.2)).map(|t| t.solid_angle).sum();
        agrees(id, sum, value, 1e-9);
        if let Some(rectangle) = SphericalRectangle::new(corner, u, v) {
            agrees(id, rectangle.solid_angle, value, 1e-8);
        }
    }
    for (id, case, value) in cases(&table, "CF41") {
        let c = corners(&case["params"]["v"]);
        agrees(id, solid_angle::triangle(c[0], c[1], c[2]).abs(), value, 1e-12);
    }
    for (id, case, value) in cases(&table, "CF42") {
        let p = &case["params"];
        let got = match (p.get("r"), &p["a"]) {
            (Some(r), _) => {
                let d = number(&p["d"]);
                solid_angle::cone(solid_angle::ball_versin(number(r), d * d).unwrap())
            }
            (None, a) if number(a) == 0.0 => {
                let (r, h) = (number(&p["R"]), number(&p["h"]));
                solid_angle::cone(solid_angle::versin(real::atan2(r, h)))
            }
            // An off-axis disk has no elementary form and none here.
            _ => continue,
        };
        // CF42c: 1 − (r/d)² is the difference of neighbours, 10⁻⁶ of them.
        agrees(id, got, value, if id == "CF42c" { 1e-10 } else { 1e-12 });
    }
}

/// E of one light of the table for the unit normal n at the lit point p; `None` for kinds without a form here.
fn irradiance(light: &Value, p: DVec3, n: DVec3) -> Option<f64> {
    let at = |name: &str| vector(&light[name]) - p;
    Some(match light["type"].as_str().unwrap() {
        "rect" => {
            let (c, u, v) = (at("corner"), vector(&light["u"]), vector(&light["v"]));
            closed::polygon(&[c, c + u, c + u + v, c + v], n).max(0.0)
        }
        // The table's triangles and polygons face the point, whichever way they run.
        "triangle" | "polygon" => {
            let c: Vec<DVec3> = corners(&light["v"]).iter().map(|x| *x - p).collect();
            closed::polygon(&c, n).abs()
        }
        "disk" => {
            let (c, m, r) = (at("center"), vector(&light["normal"]), number(&light["radius"]));
            let above = n.dot(c) > r * (1.0 - n.dot(m) * n.dot(m)).sqrt();
            if above {
                closed::disk(c, m, r, n)
            } else {
                // Only the coaxial one has a form: a cone.
                let versin = solid_angle::versin(real::atan2(r, c.length()));
                closed::cone(versin, n.dot(c) / c.length())
            }
        }
        "sphere" => {
            let (c, r) = (at("center"), number(&light["radius"]));
            closed::cone(solid_angle::ball_versin(r, c.length_squared())?, n.dot(c) / c.length())
        }
        "sun_disc" => {
            let versin = solid_angle::versin(number(&light["half_angle_rad"]));
            closed::cone(versin, n.dot(vector(&light["dir_to_light"]))) * number(&light["Le"])
        }
        _ => return None,
    })
}

#[test]
fn irradiances() {
    let Some(table) = table() else { return };
    for row in ["CF03", "CF04", "CF05", "CF06", "CF07", "CF08", "CF09", "CF10", "CF11"] {
        for (id, case, value) in cases(&table, row) {
            let (p, n) = (&case["scene"]["receiver"]["p"], &case["scene"]["receiver"]["n"]);
            let light = &case["scene"]["lights"][0];
            let Some(got) = irradiance(light, vector(p), vector(n).normalize()) else { continue };
            let tolerance = match id {
                // The infinite strip is a strip of length 2·10⁶ here.
                "CF11a" => 1e-11,
                // The horizon cuts a sun of half-angle 5·10⁻³: the form cancels like its square, 10⁻¹⁶/2·10⁻⁵.
                "CF03c" | "CF03d" => 1e-10,
                _ => 1e-12,
            };
            agrees(id, got, value, tolerance);
        }
    }
}

#[test]
fn skies() {
    let Some(table) = table() else { return };
    let tilt = |case: &Value| {
        let n = vector(&case["scene"]["receiver"]["n"]);
        real::atan2(n.x, n.y)
    };
    for (id, case, value) in cases(&table, "CF12") {
        agrees(id, closed::sky_over_ground(tilt(case)), value, 1e-12);
    }
    for (id, case, value) in cases(&table, "CF15") {
        agrees(id, closed::overcast(tilt(case)), value, 1e-12);
    }
    for (id, case, value) in cases(&table, "CF14").into_iter().take(3) {
        let m = vector(&case["scene"]["env"]["m"]);
        agrees(id, closed::cosine_lobe(real::atan2(m.x, m.y)), value, 1e-12);
    }
    for (id, case, value) in cases(&table, "CF17").into_iter().take(2) {
        let env = &case["scene"]["env"];
        let (g, p) = ([0, 1].map(|i| number(&env["g"][i])), [0, 1].map(|i| number(&env["p"][i])));
        agrees(id, closed::zone(g, p[1] - p[0]), value, 1e-12);
    }
    let strip = [1.0f64, 2.0].map(|x| real::atan2(x, 2.0));
    agrees("CF11a", closed::strip(strip), cases(&table, "CF11")[0].2, 1e-12);
    agrees("CF11c", closed::tube(0.25, 2.0, 1.0), cases(&table, "CF11")[2].2, 1e-12);
}

/// The two forms of a cone that the horizon cuts agree where they meet: the straight horizon is off by α², the exact form
/// by 2⁻⁵³/α², of α³.
#[test]
fn small_cones_join() {
    for h in [-0.9, -0.3, 0.0, 0.5, 0.99] {
        let at = |alpha: f64| closed::cone(solid_angle::versin(alpha), h * real::sin(alpha)) / alpha.powi(3);
        assert!((at(0.99e-4) - at(1.01e-4)).abs() < 1e-7);
    }
    // Cut in half: ∫ of the half disk, (2/3) α³.
    agrees("half", closed::cone(solid_angle::versin(1e-7), 0.0), 2.0 / 3.0 * 1e-21, 1e-9);
    assert_eq!(closed::cone(1.0, 1.0), PI);
}
