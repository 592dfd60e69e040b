//! The table of closed forms: cases with their values.

use std::path::PathBuf;

use serde_json::Value;

/// A case of the table.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its stable name: "CF04a".
    pub id: String,
    /// E, AO, V, L, F, flux, Omega, length, fraction, variance, …
    pub quantity: String,
    /// The truth.
    pub value: f64,
    /// Receiver, lights, occluders, environment; null where the case has `params`.
    pub scene: Value,
    /// Numbers of cases without a scene.
    pub params: Value,
}

impl Case {
    /// A number among the parameters.
    pub fn number(&self, name: &str) -> f64 {
        number(&self.params[name])
    }
}

/// All cases; `None` (and a line that says so) where the table is not there, a failure where `CI` is `true`.
pub fn cases(test: &str) -> Option<Vec<Case>> {
    let beside = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data");
    let data = std::env::var_os("ANTUMBRA_DATA").map_or(beside, PathBuf::from);
    let path = data.join("../closed_forms.json");
    let Ok(text) = std::fs::read_to_string(&path) else {
        assert!(std::env::var("CI").as_deref() != Ok("true"), "{test}: no table at {}", path.display());
        eprintln!("skipped: {test} needs the table {}", path.display());
        return None;
    };
    let table: Value = serde_json::from_str(&text).unwrap();
    let cases = list(&table["rows"]).iter().flat_map(|row| list(&row["cases"]));
    let word = |v: &Value| v.as_str().unwrap().to_string();
    let case = |c: &Value| Case {
        id: word(&c["case"]),
        quantity: word(&c["quantity"]),
        value: number(&c["value_f64"]),
        scene: c["scene"].clone(),
        params: c["params"].clone(),
    };
    Some(cases.map(case).collect())
}

/// A number.
pub fn number(v: &Value) -> f64 {
    v.as_f64().unwrap_or_else(|| panic!("{v} is not a number"))
}

/// The entries of a list; none where there is no list.
pub fn list(v: &Value) -> &[Value] {
    v.as_array().map_or(&[], Vec::as_slice)
}

/// N numbers.
pub fn numbers<const N: usize>(v: &Value) -> [f64; N] {
    std::array::from_fn(|i| number(&v[i]))
}

/// How a case is tested.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Irradiance by every estimator that can see its lights.
    Irradiance,
    /// Ambient occlusion.
    Openness,
    /// Visible fraction.
    Visible,
    /// Borders of shadows.
    Lengths,
    /// Variance of an estimator with one sample.
    Variance,
    /// A closed form of our own.
    Formula,
    /// Radiance between surfaces.
    Furnace,
    /// Not at all, and why.
    Left(&'static str),
}

/// The way of every case. A case that no way knows fails in the test of its quantity.
pub fn way(case: &Case) -> Way {
    match (case.id.as_str(), case.quantity.as_str()) {
        ("CF11c" | "CF11d", _) => Way::Left("there is no tube light"),
        ("CF22c", _) => Way::Left("the flat-lens approximation is none of our functions"),
        ("CF31a" | "CF31b" | "CF31c" | "CF31d", _) => Way::Left("there is no query of bent normals"),
        ("CF38a" | "CF38b" | "CF38c" | "CF38d", _) => Way::Left("nothing plans the split of rays"),
        ("CF44f" | "CF44g", _) => Way::Left("nothing is baked at vertices"),
        (_, "E" | "F") => Way::Irradiance,
        (_, "AO") => Way::Openness,
        (_, "V" | "fraction") => Way::Visible,
        (_, "length") => Way::Lengths,
        (_, "variance") => Way::Variance,
        (_, "Omega" | "flux") => Way::Formula,
        (_, "L") => Way::Furnace,
        (id, quantity) => panic!("{id}: nothing tests the quantity {quantity}"),
    }
}

/// The cases that are tested in this way.
pub fn cases_of(test: &str, wanted: Way) -> Option<Vec<Case>> {
    Some(cases(test)?.into_iter().filter(|c| way(c) == wanted).collect())
}

#[test]
fn left_out_cases_are_known_by_name() {
    let Some(cases) = cases("left_out_cases_are_known_by_name") else { return };
    let mut left = Vec::new();
    for case in &cases {
        if let Way::Left(why) = way(case) {
            println!("left out: {} ({why})", case.id);
            left.push(case.id.as_str());
        }
    }
    let known = "CF11c CF11d CF22c CF31a CF31b CF31c CF31d CF44f CF44g CF38a CF38b CF38c CF38d";
    assert_eq!(left.join(" "), known);
    println!("{} of {} cases are tested", cases.len() - left.len(), cases.len());
}
