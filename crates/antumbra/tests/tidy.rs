//! The house as a test: floors, sizes, and what is deliberately absent.

use std::fs;
use std::path::{Path, PathBuf};

/// Rooms of the core with their floors: a room imports only from lower floors.
const FLOORS: &[(&str, u32)] = &[
    ("density", 1),
    ("bsdf", 2),
    ("film", 2),
    ("sampler", 2),
    ("texture", 2),
    ("receiver", 3),
    ("light", 4),
    ("scene", 5),
    ("estimator", 6),
    ("sensor", 6),
    ("illuminate", 7),
    ("settings", 7),
    ("schedule", 8),
    ("query", 9),
    ("render", 10),
];

/// Which workspace crates a crate may name.
const CRATES: &[(&str, &[&str])] = &[
    ("antumbra-math", &[]),
    ("antumbra-trace", &["antumbra_math"]),
    ("antumbra", &["antumbra_math", "antumbra_trace"]),
    ("antumbra-io", &["antumbra", "antumbra_math", "antumbra_trace"]),
    ("antumbra-py", &["antumbra", "antumbra_io", "antumbra_math", "antumbra_trace"]),
];

const LONGEST_FILE: usize = 400;
const LONGEST_FUNCTION: usize = 60;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Every file with this ending below a folder, with its text.
fn files(folder: &Path, ending: &str) -> Vec<(PathBuf, String)> {
    let mut found = Vec::new();
    let Ok(entries) = fs::read_dir(folder) else { return found };
    for path in entries.flatten().map(|e| e.path()) {
        if path.is_dir() {
            found.extend(files(&path, ending));
        } else if path.extension().is_some_and(|e| e == ending) {
            let text = fs::read_to_string(&path).expect("source files are text");
            found.push((path, text));
        }
    }
    found
}

fn assert_none(faults: Vec<String>) {
    assert!(faults.is_empty(), "\n{}", faults.join("\n"));
}

/// Code without comments.
fn code(text: &str) -> String {
    text.lines().map(|l| l.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

#[test]
fn rooms_import_from_lower_floors_only() {
    let source = root().join("crates/antumbra/src");
    let floor = |room: &str| FLOORS.iter().find(|(name, _)| *name == room).map(|(_, floor)| *floor);
    let mut faults = Vec::new();
    for (path, text) in files(&source, "rs") {
        let inside = path.strip_prefix(&source).unwrap();
        let first = inside.iter().next().unwrap().to_string_lossy();
        let room = first.trim_end_matches(".rs").to_string();
        if room == "lib" {
            continue;
        }
        let Some(own) = floor(&room) else {
            faults.push(format!("{}: room {room} has no floor", inside.display()));
            continue;
        };
        for import in code(&text).split("crate::").skip(1) {
            let name: String = import.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
            if floor(&name).is_some_and(|other| name != room && other >= own) {
                faults.push(format!("{}: floor {own} imports {name}", inside.display()));
            }
        }
    }
    assert_none(faults);
}

#[test]
fn crates_name_only_crates_below() {
    let all = ["antumbra_math", "antumbra_trace", "antumbra_io", "antumbra_py"];
    let mut faults = Vec::new();
    for (name, allowed) in CRATES {
        for (path, text) in files(&root().join("crates").join(name).join("src"), "rs") {
            let code = code(&text);
            let foreign = all.iter().filter(|c| code.contains(&format!("{c}::")) && !allowed.contains(c));
            faults.extend(foreign.map(|c| format!("{}: names {c}", path.display())));
        }
    }
    assert_none(faults);
}

#[test]
fn files_are_one_idea() {
    let mut faults = Vec::new();
    for (path, text) in files(&root().join("crates"), "rs").iter().chain(&files(&root().join("python"), "py"))
    {
        let lines = text.lines().count();
        if lines > LONGEST_FILE {
            faults.push(format!("{}: {lines} lines", path.display()));
        }
        let rust = path.extension().is_some_and(|e| e == "rs");
        // A docstring with backslashes is a raw one.
        let docstring = text.strip_prefix('r').unwrap_or(text).starts_with("\"\"\"");
        let opens_well = if rust { text.starts_with("//!") } else { docstring };
        if !opens_well && !text.trim().is_empty() {
            faults.push(format!("{}: its first line does not say what it is", path.display()));
        }
    }
    assert_none(faults);
}

/// A function begins at a line with `fn name` and ends at the line that closes its indentation.
#[test]
fn functions_fit_a_screen() {
    let mut faults = Vec::new();
    for (path, text) in files(&root().join("crates"), "rs") {
        let lines: Vec<&str> = text.lines().collect();
        for (i, line) in lines.iter().enumerate() {
            let body = line.trim_start();
            let is_function =
                ["fn ", "pub fn ", "pub(crate) fn ", "pub(super) fn ", "const fn ", "unsafe fn "]
                    .iter()
                    .any(|start| body.starts_with(start));
            if !is_function {
                continue;
            }
            let indent = line.len() - body.len();
            let closing = format!("{}}}", " ".repeat(indent));
            let length = lines[i..].iter().position(|l| *l == closing).map_or(0, |n| n + 1);
            let one_liner = line.trim_end().ends_with([';', '}']);
            if !one_liner && length > LONGEST_FUNCTION {
                faults.push(format!("{}:{}: {length} lines: {body}", path.display(), i + 1));
            }
        }
    }
    assert_none(faults);
}

#[test]
fn the_core_is_pure() {
    let absent = [
        ("std::fs", "opens no file"),
        ("std::net", "opens no connection"),
        ("Instant", "reads no clock"),
        ("SystemTime", "reads no clock"),
        ("std::env", "reads no environment"),
        ("println!", "prints nothing"),
        ("static mut", "has no global state"),
    ];
    let mut faults = Vec::new();
    for name in ["antumbra-math", "antumbra-trace", "antumbra"] {
        for (path, text) in files(&root().join("crates").join(name).join("src"), "rs") {
            let tests = path.to_string_lossy().contains("tests");
            let code = code(text.split("#[cfg(test)]").next().unwrap_or_default());
            for (word, why) in absent {
                if !tests && code.contains(word) {
                    faults.push(format!("{}: {word} ({name} {why})", path.display()));
                }
            }
            if name == "antumbra" && !path.ends_with("schedule.rs") && code.contains("rayon") {
                faults.push(format!("{}: only schedule uses threads", path.display()));
            }
            if name != "antumbra-trace" && code.contains("unsafe ") {
                faults.push(format!("{}: unsafe lives in trace only", path.display()));
            }
        }
    }
    assert_none(faults);
}

#[test]
fn nothing_is_left_unfinished() {
    let marks = [
        ["TO", "DO"].concat(),
        ["FIX", "ME"].concat(),
        ["todo", "!("].concat(),
        ["unimplemented", "!("].concat(),
    ];
    let mut faults = Vec::new();
    for (path, text) in files(&root().join("crates"), "rs").iter().chain(&files(&root().join("python"), "py"))
    {
        faults.extend(marks.iter().filter(|m| text.contains(*m)).map(|m| format!("{}: {m}", path.display())));
    }
    assert_none(faults);
}
