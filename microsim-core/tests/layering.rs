//! Who may use whom inside the core (docs/architecture.md), and what the core may not do at all.
//!
//! Sources are read as text: comments, string contents and everything under `#[cfg(test)]` are blanked out, then each
//! `crate::` and `super::` path is resolved to a path from the crate's root.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Every module and what it may use besides itself, as path prefixes.
const LAYERS: &[(&str, &[&str])] = &[
    ("error", &[]),
    ("id", &[]),
    ("kind", &[]),
    ("rng", &[]),
    ("fnv", &[]),
    ("walk", &[]),
    ("look", &[]),
    ("spec_field", &["error"]),
    ("geometry", &[]),
    ("shared", &[]),
    ("particle", &["shared"]),
    ("parallel", &[]),
    ("config", &["error"]),
    ("inputs", &["error", "id"]),
    ("event", &["id", "kind"]),
    ("collision", &["geometry", "parallel", "particle", "shared"]),
    ("solver", &["collision", "config", "error", "geometry", "parallel", "particle", "spec_field"]),
    ("template", &["error", "geometry", "particle", "solver"]),
    ("chemical", &["config", "error"]),
    ("capability", &["chemical", "collision::obstacle", "config", "error", "geometry", "id", "rng", "spec_field"]),
    (
        "organism",
        &[
            "capability",
            "collision",
            "error",
            "geometry",
            "id",
            "kind",
            "look",
            "particle",
            "rng",
            "shared",
            "solver",
            "spec_field",
            "template",
        ],
    ),
    (
        "behavior",
        &[
            "capability",
            "chemical",
            "event",
            "geometry",
            "id",
            "inputs",
            "organism",
            "particle",
            "solver::contraction",
            "solver::drive",
        ],
    ),
    // The step takes the world apart and hands each phase what it needs, so these two know each other.
    (
        "step",
        &[
            "behavior",
            "capability",
            "collision",
            "config",
            "event",
            "inputs",
            "organism",
            "parallel",
            "particle",
            "solver",
            "world",
        ],
    ),
    (
        "world",
        &[
            "behavior",
            "capability",
            "chemical",
            "collision",
            "config",
            "error",
            "event",
            "fnv",
            "geometry",
            "id",
            "inputs",
            "kind",
            "organism",
            "parallel",
            "particle",
            "rng",
            "shared",
            "solver",
            "step",
            "template",
            "walk",
        ],
    ),
    ("snapshot", &["collision", "fnv", "id", "scenario", "world"]),
    ("replay", &["fnv", "id", "inputs", "scenario", "world"]),
    (
        "microscope",
        &["collision::obstacle", "error", "geometry", "kind", "look", "organism::look", "template", "world"],
    ),
];

/// Modules that see the crate as an embedder does: only what `lib.rs` makes public.
const OUTSIDERS: &[&str] = &["scenario"];

/// Where the code is not yet what the table says. Each entry has to be in use; delete it with the last use.
const EXCEPTIONS: &[(&str, &str, &str)] = &[];

/// What no source of the core contains: the core does no input or output, reads no clock, prints nothing and has no
/// threads and no global state.
const FORBIDDEN: &[&str] = &[
    "println!",
    "eprintln!",
    "print!",
    "eprint!",
    "dbg!",
    "std::env",
    "std::fs",
    "std::io",
    "std::net",
    "std::process",
    "std::thread",
    "std::time",
    "thread_local!",
    "OnceLock",
    "LazyLock",
    "static mut",
];

/// The dependencies that every user of the core gets.
const DEPENDENCIES: &[&str] = &["glam", "libm", "parry2d", "serde"];

#[test]
fn modules_use_only_what_lies_below_them() {
    let sources = sources();
    let public = public_names(&sources["lib"]);
    let mut wrong = Vec::new();
    let mut needed = BTreeSet::new();
    for source in sources.values().flatten().filter(|source| source.module() != "lib") {
        for (line, used) in source.paths() {
            let module = source.module();
            let exception = EXCEPTIONS.iter().position(|(m, prefix, _)| *m == module && is_within(&used, prefix));
            needed.extend(exception);
            if exception.is_none() && !may_use(module, &used, &public) {
                let place = source.path.display();
                wrong.push(format!("src/{place}:{line}: `{module}` may not use `crate::{}`", used.join("::")));
            }
        }
    }
    assert!(wrong.is_empty(), "{}\nthe rules are in tests/layering.rs, LAYERS", wrong.join("\n"));
    for (k, (module, prefix, _)) in EXCEPTIONS.iter().enumerate() {
        assert!(needed.contains(&k), "`{module}` no longer uses `{prefix}`: delete the entry from EXCEPTIONS");
    }
}

#[test]
fn every_module_has_its_place_in_the_table() {
    let known: BTreeSet<&str> = LAYERS.iter().map(|(module, _)| *module).chain(OUTSIDERS.iter().copied()).collect();
    let sources = sources();
    let found: BTreeSet<&str> = sources.keys().map(String::as_str).filter(|module| *module != "lib").collect();
    assert_eq!(found, known, "left: modules in src, right: modules in tests/layering.rs");
}

#[test]
fn the_core_does_no_input_or_output_and_keeps_no_global_state() {
    let mut wrong = Vec::new();
    for source in sources().values().flatten() {
        for (number, line) in source.text.lines().enumerate() {
            for what in FORBIDDEN.iter().filter(|what| has_word(line, what)) {
                wrong.push(format!("src/{}:{}: `{what}`", source.path.display(), number + 1));
            }
        }
    }
    assert!(wrong.is_empty(), "not for the core:\n{}", wrong.join("\n"));
}

#[test]
fn the_core_depends_on_vectors_shapes_portable_mathematics_and_serde_only() {
    let manifest = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("Cargo.toml")).unwrap();
    let (mut section, mut found) = (String::new(), BTreeSet::new());
    for line in manifest.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#')) {
        if line.starts_with('[') {
            section = line.to_owned();
            let has_hidden = section.contains("dependencies.") || section.contains("target.");
            assert!(!has_hidden, "Cargo.toml: list dependencies in plain tables, not in {section}");
        } else if section == "[dependencies]" && !line.replace(' ', "").contains("optional=true") {
            found.insert(line.split(['.', '=', ' ']).next().unwrap());
        }
    }
    assert_eq!(found, DEPENDENCIES.iter().copied().collect(), "non-optional [dependencies] of microsim-core");
}

#[test]
fn the_scan_sees_code_and_nothing_else() {
    let text = "use crate::{a::{B, c::d}, e};\n// crate::f\nlet s = \"{ crate::g\";\nlet c = '\"';\nsuper::super::h();\n\
                #[cfg(test)]\nmod tests { use crate::i; }\nfn k<'a>(x: &'a crate::l::M) {}\n";
    let source = Source::new(PathBuf::from("x/y.rs"), text);
    let paths: Vec<_> = source.paths().into_iter().map(|(line, path)| (line, path.join("::"))).collect();
    let expected = [(1, "a::B"), (1, "a::c::d"), (1, "e"), (5, "h"), (8, "l::M")];
    assert_eq!(paths, expected.map(|(line, path)| (line, path.to_owned())));
}

fn may_use(module: &str, used: &[String], public: &BTreeSet<String>) -> bool {
    if used.first().is_none_or(|first| first == module) {
        return true;
    }
    if OUTSIDERS.contains(&module) {
        // The item: the first name in capitals, or a function at the end.
        let item = used.iter().find(|name| name.starts_with(char::is_uppercase)).or(used.last());
        return public.contains(&used[0]) || item.is_some_and(|item| public.contains(item));
    }
    let rule = LAYERS.iter().find(|(name, _)| *name == module);
    rule.is_none_or(|(_, allowed)| allowed.iter().any(|prefix| is_within(used, prefix)))
}

fn is_within(path: &[String], prefix: &str) -> bool {
    let prefix: Vec<&str> = prefix.split("::").collect();
    path.len() >= prefix.len() && path.iter().zip(prefix).all(|(a, b)| a == b)
}

/// Whether `line` contains `what` with no letter right before it.
fn has_word(line: &str, what: &str) -> bool {
    let before = |at: usize| line[..at].chars().next_back();
    line.match_indices(what).any(|(at, _)| before(at).is_none_or(|c| !c.is_alphanumeric() && c != '_'))
}

/// Names that `lib.rs` exports: public modules and everything after `pub use`.
fn public_names(lib: &[Source]) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for statement in lib[0].text.split(';').map(str::trim) {
        let after = |keyword: &str| statement.rsplit_once(keyword).map(|(_, rest)| rest.trim());
        if let Some(name) = after("pub mod ") {
            names.insert(name.to_owned());
        } else if let Some(tree) = after("pub use ") {
            let mut found = Vec::new();
            expand(tree, &mut Vec::new(), &mut found);
            names.extend(found.into_iter().filter_map(|path| path.last().cloned()));
        }
    }
    names
}

/// One file of `src` without comments, string contents and test code.
struct Source {
    /// Below `src`.
    path: PathBuf,
    text: String,
    /// Modules of this file that are declared under `#[cfg(test)]`.
    test_modules: Vec<String>,
}

impl Source {
    fn new(path: PathBuf, text: &str) -> Self {
        let (text, test_modules) = without_tests(&without_comments(text));
        Self { path, text, test_modules }
    }

    /// The top-level module that the file belongs to.
    fn module(&self) -> &str {
        self.path.iter().next().unwrap().to_str().unwrap().trim_end_matches(".rs")
    }

    /// Path of the file's own module from the crate's root.
    fn own_path(&self) -> Vec<String> {
        let names = self.path.with_extension("");
        let names = names.iter().map(|name| name.to_str().unwrap().to_owned());
        names.filter(|name| name != "mod" && name != "lib").collect()
    }

    /// All `crate::` and `super::` paths with their lines, from the crate's root.
    fn paths(&self) -> Vec<(usize, Vec<String>)> {
        let mut paths = Vec::new();
        for (number, line) in (1..).zip(starts_of_lines(&self.text)) {
            let end = self.text[line..].find('\n').map_or(self.text.len(), |length| line + length);
            let mut at = line;
            while let Some((start, mut base, rest)) = next_path(&self.text, at, end, &self.own_path()) {
                let mut found = Vec::new();
                expand(&self.text[rest..], &mut base, &mut found);
                paths.extend(found.into_iter().map(|path| (number, path)));
                at = start + 1;
            }
        }
        paths
    }
}

fn starts_of_lines(text: &str) -> impl Iterator<Item = usize> + '_ {
    std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1))
}

/// The next path in `at..end`: where it starts, what it starts from, and where its names begin.
fn next_path(text: &str, at: usize, end: usize, own: &[String]) -> Option<(usize, Vec<String>, usize)> {
    let find = |keyword: &str| {
        text[at..end].match_indices(keyword).map(|(offset, _)| at + offset).find(|&start| {
            let before = text[..start].chars().next_back();
            before.is_none_or(|c| !c.is_alphanumeric() && c != '_' && c != ':' && c != '$')
        })
    };
    match (find("crate::"), find("super::")) {
        (Some(c), s) if s.is_none_or(|s| c < s) => Some((c, Vec::new(), c + "crate::".len())),
        (_, Some(start)) => {
            let (mut base, mut rest) = (own.to_vec(), start);
            while text[rest..].starts_with("super::") {
                base.pop();
                rest += "super::".len();
            }
            Some((start, base, rest))
        }
        _ => None,
    }
}

/// Expands a use tree such as `a::{B, c::D as E}` into its paths; returns what follows it.
fn expand<'a>(tree: &'a str, base: &mut Vec<String>, found: &mut Vec<Vec<String>>) -> &'a str {
    let depth = base.len();
    let mut rest = tree.trim_start();
    loop {
        if let Some(inner) = rest.strip_prefix('{') {
            rest = inner.trim_start();
            while !rest.starts_with('}') && !rest.is_empty() {
                rest = expand(rest, base, found).trim_start();
                rest = rest.strip_prefix(',').unwrap_or(rest).trim_start();
            }
            rest = rest.strip_prefix('}').unwrap_or(rest);
            break;
        }
        let length = rest.find(|c: char| !c.is_alphanumeric() && c != '_' && c != '*').unwrap_or(rest.len());
        let (name, after) = rest.split_at(length);
        if name.is_empty() {
            return rest.get(1..).unwrap_or("");
        }
        if !matches!(name, "self" | "*") {
            base.push(name.to_owned());
        }
        match after.strip_prefix("::") {
            Some(after) if !after.starts_with('<') => rest = after,
            _ => {
                found.push(base.clone());
                rest = after;
                break;
            }
        }
    }
    base.truncate(depth);
    let renamed = rest.trim_start().strip_prefix("as ");
    renamed.map_or(rest, |name| name.trim_start_matches(|c: char| c.is_alphanumeric() || c == '_'))
}

/// Blanks out comments and the contents of strings and characters; lines keep their numbers.
fn without_comments(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            rest.find("*/").map_or(rest.len(), |end| end + 2)
        } else if first == '"' {
            length_of_string(rest)
        } else if rest.starts_with("r\"") || rest.starts_with("r#") {
            length_of_raw_string(rest)
        } else if first == '\'' {
            length_of_character(rest)
        } else {
            out.push(first);
            rest = &rest[first.len_utf8()..];
            continue;
        };
        out.extend(rest[..length].chars().map(|c| if c == '\n' { '\n' } else { ' ' }));
        rest = &rest[length..];
    }
    out
}

fn length_of_string(text: &str) -> usize {
    let mut is_escaped = false;
    for (at, c) in text.char_indices().skip(1) {
        match c {
            '"' if !is_escaped => return at + 1,
            _ => is_escaped = c == '\\' && !is_escaped,
        }
    }
    text.len()
}

fn length_of_raw_string(text: &str) -> usize {
    let hashes = text[1..].chars().take_while(|&c| c == '#').count();
    let opening = 2 + hashes;
    if !text[1 + hashes..].starts_with('"') {
        return opening - 1; // A raw identifier.
    }
    let closing = format!("\"{}", "#".repeat(hashes));
    text[opening..].find(&closing).map_or(text.len(), |end| opening + end + closing.len())
}

/// Length of a character literal, or 1 for the quote of a lifetime.
fn length_of_character(text: &str) -> usize {
    let mut characters = text.char_indices().skip(1);
    let (_, first) = characters.next().unwrap_or((0, ' '));
    let closing =
        if first == '\\' { text[2..].find('\'').map(|at| at + 2) } else { characters.next().map(|(at, _)| at) };
    closing.filter(|&at| text[at..].starts_with('\'')).map_or(1, |at| at + 1)
}

/// Blanks out every item under `#[cfg(test)]`; returns the modules in other files among them.
fn without_tests(text: &str) -> (String, Vec<String>) {
    const MARK: &str = "#[cfg(test)]";
    let (mut out, mut modules, mut rest) = (String::new(), Vec::new(), text);
    while let Some(start) = rest.find(MARK) {
        let length = length_of_item(&rest[start..]);
        let item = &rest[start..start + length];
        if let Some((_, name)) = item.trim_end_matches(';').rsplit_once("mod ") {
            modules.extend(item.ends_with(';').then(|| name.to_owned()));
        }
        out.push_str(&rest[..start]);
        out.extend(item.chars().filter(|&c| c == '\n'));
        rest = &rest[start + length..];
    }
    out.push_str(rest);
    (out, modules)
}

fn length_of_item(text: &str) -> usize {
    let mut depth = 0;
    for (at, c) in text.char_indices() {
        match c {
            ';' if depth == 0 => return at + 1,
            '{' => depth += 1,
            '}' if depth == 1 => return at + 1,
            '}' => depth -= 1,
            _ => {}
        }
    }
    text.len()
}

/// All sources of the core by their top-level module.
fn sources() -> BTreeMap<String, Vec<Source>> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    collect(&root, &root, &mut files);
    let tests: BTreeSet<PathBuf> = files
        .iter()
        .flat_map(|source| {
            let folder: PathBuf = source.own_path().iter().collect();
            source.test_modules.iter().map(move |module| folder.join(module).with_extension("rs"))
        })
        .collect();
    let mut sources: BTreeMap<String, Vec<Source>> = BTreeMap::new();
    for source in files.into_iter().filter(|source| !tests.contains(&source.path)) {
        sources.entry(source.module().to_owned()).or_default().push(source);
    }
    sources
}

fn collect(folder: &Path, root: &Path, files: &mut Vec<Source>) {
    let mut entries: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            collect(&path, root, files);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = fs::read_to_string(&path).unwrap();
            files.push(Source::new(path.strip_prefix(root).unwrap().to_owned(), &text));
        }
    }
}
