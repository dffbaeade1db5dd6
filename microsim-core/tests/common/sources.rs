//! The sources of a crate as tokens, without comments, text in strings and tests: what each file uses, and which files
//! use each other in a circle.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// A word, a mark or a bracket, with its line.
#[derive(Debug)]
pub(crate) struct Token {
    pub line: usize,
    pub text: String,
}

/// A path from the crate's root that a file names.
#[derive(Debug)]
pub(crate) struct Use {
    pub line: usize,
    pub path: Vec<String>,
    /// The name that the file has for it: the last of the path, or what stands behind `as`.
    name: String,
}

/// One file of `src`.
#[derive(Debug)]
pub(crate) struct Source {
    /// Below `src`.
    pub path: PathBuf,
    pub tokens: Vec<Token>,
    /// Modules that it declares.
    children: BTreeSet<String>,
    /// Modules that it declares for tests only.
    test_children: Vec<String>,
}

impl Source {
    pub(crate) fn new(path: PathBuf, text: &str) -> Self {
        let mut all = Vec::new();
        flatten(text.parse().unwrap_or_else(|error| panic!("{}: {error}", path.display())), &mut all);
        let (tokens, test_children) = without_tests(all);
        let children = modules(&tokens).map(str::to_owned).collect();
        Self { path, tokens, children, test_children }
    }

    /// The top-level module that the file belongs to.
    pub(crate) fn module(&self) -> &str {
        self.path.iter().next().unwrap().to_str().unwrap().trim_end_matches(".rs")
    }

    /// Path of the file's own module from the crate's root.
    pub(crate) fn own_path(&self) -> Vec<String> {
        let names = self.path.with_extension("");
        let names = names.iter().map(|name| name.to_str().unwrap().to_owned());
        names.filter(|name| !matches!(name.as_str(), "mod" | "lib" | "main")).collect()
    }

    /// All paths that begin with `crate`, `super`, `self` or a module that the file declares.
    pub(crate) fn uses(&self) -> Vec<Use> {
        let mut found = Vec::new();
        for at in 0..self.tokens.len() {
            if let Some((mut base, rest)) = self.start_of_path(at) {
                expand(&self.tokens, rest, &mut base, &mut found);
            }
        }
        found
    }

    /// What a path that begins at a token is relative to, and where its other names begin.
    fn start_of_path(&self, at: usize) -> Option<(Vec<String>, usize)> {
        if self.text(at + 1) != "::" || at > 0 && matches!(self.text(at - 1), "::" | "mod") {
            return None;
        }
        let own = self.own_path();
        match self.text(at) {
            "crate" => Some((Vec::new(), at + 2)),
            "self" => Some((own, at + 2)),
            "super" => {
                let (mut base, mut rest) = (own, at);
                while self.text(rest) == "super" {
                    base.pop();
                    rest += 2;
                }
                Some((base, rest))
            }
            child if self.children.contains(child) => Some((own, at)),
            _ => None,
        }
    }

    /// Names that the file makes public: modules and what it hands on.
    pub(crate) fn exports(&self) -> BTreeSet<String> {
        let mut names = BTreeSet::new();
        for at in (0..self.tokens.len()).filter(|&at| self.text(at) == "pub") {
            if self.text(at + 1) == "mod" {
                names.insert(self.text(at + 2).to_owned());
            } else if self.text(at + 1) == "use" {
                let mut found = Vec::new();
                expand(&self.tokens, at + 2, &mut Vec::new(), &mut found);
                names.extend(found.into_iter().map(|used| used.name));
            }
        }
        names
    }

    /// Lines where the tokens of `what` stand one after the other.
    pub(crate) fn lines_with(&self, what: &str) -> Vec<usize> {
        let mut wanted = Vec::new();
        flatten(what.parse().unwrap(), &mut wanted);
        let is_there = |window: &&[Token]| window.iter().zip(&wanted).all(|(a, b)| a.text == b.text);
        self.tokens.windows(wanted.len()).filter(is_there).map(|window| window[0].line).collect()
    }

    fn text(&self, at: usize) -> &str {
        self.tokens.get(at).map_or("", |token| &token.text)
    }
}

/// All sources below a folder; those of tests are left out.
pub(crate) fn sources(root: &Path) -> Vec<Source> {
    let mut files = Vec::new();
    collect(root, root, &mut files);
    let of_tests = |source: &Source| {
        let folder: PathBuf = source.own_path().iter().collect();
        let children = source.test_children.iter();
        children.map(move |child| folder.join(child)).collect::<Vec<_>>()
    };
    let tests: BTreeSet<PathBuf> = files.iter().flat_map(of_tests).collect();
    files.retain(|source| !tests.contains(&source.path.with_extension("")));
    files
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

/// Circles of files that use each other. A module and what lies inside it may use each other.
pub(crate) fn circles(sources: &[Source]) -> BTreeSet<String> {
    let files: Files = sources.iter().map(|source| (source.own_path(), source)).collect();
    let all: Graph = files.iter().map(|(own, source)| (own, neighbours(own, source, &files))).collect();
    let is_downward = |own: &Vec<String>, used: &&Vec<String>| !own.starts_with(used);
    let downward: Graph = all
        .iter()
        .map(|(own, used)| (*own, used.iter().copied().filter(|used| is_downward(own, used)).collect()))
        .collect();
    let has_parent = |circle: &&BTreeSet<&Vec<String>>| circle.iter().any(|p| circle.iter().all(|c| c.starts_with(p)));
    let through_parents = knots(&all);
    knots(&downward)
        .into_iter()
        .chain(through_parents.into_iter().filter(|circle| !has_parent(&circle)))
        .map(named)
        .collect()
}

/// Circles of top-level modules: their files use each other, though no two files need do.
pub(crate) fn circles_of_modules(sources: &[Source]) -> BTreeSet<String> {
    let files: Files = sources.iter().map(|source| (source.own_path(), source)).collect();
    let tops: BTreeSet<Vec<String>> =
        files.keys().filter_map(|own| own.first()).map(|name| vec![name.clone()]).collect();
    let top_of = |file: &Vec<String>| tops.get(file.get(..1)?);
    let mut graph: Graph = tops.iter().map(|top| (top, BTreeSet::new())).collect();
    for (own, source) in &files {
        let used = neighbours(own, source, &files).into_iter().filter_map(top_of);
        if let Some((top, of_top)) = top_of(own).and_then(|top| Some((top, graph.get_mut(top)?))) {
            of_top.extend(used.filter(|used| *used != top));
        }
    }
    knots(&graph).into_iter().map(named).collect()
}

fn named(circle: BTreeSet<&Vec<String>>) -> String {
    circle.into_iter().map(|file| file.join("/")).collect::<Vec<_>>().join(" <-> ")
}

/// The files of a crate by the path of their module.
type Files<'a> = BTreeMap<Vec<String>, &'a Source>;

/// What each file uses.
type Graph<'a> = BTreeMap<&'a Vec<String>, BTreeSet<&'a Vec<String>>>;

/// The files that a file uses, but for the crate's root.
fn neighbours<'a>(own: &[String], source: &Source, files: &'a Files<'_>) -> BTreeSet<&'a Vec<String>> {
    let used = source.uses().into_iter().filter_map(|used| defining_file(used.path, files));
    used.filter(|file| !file.is_empty() && *file != own).collect()
}

/// Sets of files that all lead to each other.
fn knots<'a>(graph: &Graph<'a>) -> BTreeSet<BTreeSet<&'a Vec<String>>> {
    let reached: Graph = graph.keys().map(|from| (*from, everything_from(from, graph))).collect();
    let knot = |from| reached[from].iter().copied().filter(|other| reached[*other].contains(from)).collect();
    reached.keys().map(|from| knot(*from)).filter(|knot: &BTreeSet<_>| !knot.is_empty()).collect()
}

/// The file that a path leads to, through the names that modules hand on.
fn defining_file<'a>(mut path: Vec<String>, files: &'a Files<'_>) -> Option<&'a Vec<String>> {
    const LONGEST_CHAIN: usize = 8;
    for _ in 0..LONGEST_CHAIN {
        let length = (0..=path.len()).rev().find(|&length| files.contains_key(&path[..length]))?;
        let (file, source) = files.get_key_value(&path[..length])?;
        let Some(name) = path.get(length) else { return Some(file) };
        let Some(handed_on) = source.uses().into_iter().find(|used| used.name == *name) else { return Some(file) };
        path = handed_on.path.into_iter().chain(path.drain(length + 1..)).collect();
    }
    None
}

fn everything_from<'a>(from: &'a Vec<String>, graph: &Graph<'a>) -> BTreeSet<&'a Vec<String>> {
    let (mut seen, mut open) = (BTreeSet::new(), vec![from]);
    while let Some(file) = open.pop() {
        open.extend(graph[file].iter().copied().filter(|next| seen.insert(*next)));
    }
    seen
}

/// The tokens of a text in one list; what stands in strings is left out.
fn flatten(stream: TokenStream, out: &mut Vec<Token>) {
    for tree in stream {
        let line = tree.span().start().line;
        match tree {
            TokenTree::Group(group) => {
                let (open, close) = match group.delimiter() {
                    Delimiter::Parenthesis => ("(", ")"),
                    Delimiter::Brace => ("{", "}"),
                    Delimiter::Bracket => ("[", "]"),
                    Delimiter::None => ("", ""),
                };
                out.push(Token { line, text: open.to_owned() });
                flatten(group.stream(), out);
                out.push(Token { line: group.span_close().start().line, text: close.to_owned() });
            }
            TokenTree::Punct(mark) => match out.last_mut() {
                Some(last) if last.text == ":" && mark.as_char() == ':' => last.text.push(':'),
                _ => out.push(Token { line, text: mark.as_char().to_string() }),
            },
            TokenTree::Ident(word) => out.push(Token { line, text: word.to_string() }),
            TokenTree::Literal(literal) => {
                let text = literal.to_string();
                let is_number = text.starts_with(|c: char| c.is_ascii_digit());
                out.push(Token { line, text: if is_number { text } else { "\"\"".to_owned() } });
            }
        }
    }
}

/// Names of the modules that tokens declare to be in other files.
fn modules(tokens: &[Token]) -> impl Iterator<Item = &str> {
    let declarations = tokens.windows(3).filter(|window| window[0].text == "mod" && window[2].text == ";");
    declarations.map(|window| window[1].text.as_str())
}

/// Tokens without the items under `#[cfg(test)]`, and the modules in other files among those.
fn without_tests(all: Vec<Token>) -> (Vec<Token>, Vec<String>) {
    const MARK: [&str; 7] = ["#", "[", "cfg", "(", "test", ")", "]"];
    let (mut kept, mut children, mut rest) = (Vec::new(), Vec::new(), all);
    let is_mark = |window: &[Token]| window.iter().zip(MARK).all(|(token, mark)| token.text == mark);
    while let Some(start) = rest.windows(MARK.len()).position(is_mark) {
        let tail = rest.split_off(start);
        kept.append(&mut rest);
        let length = length_of_item(&tail[MARK.len()..]) + MARK.len();
        children.extend(modules(&tail[..length]).map(str::to_owned));
        rest = tail.into_iter().skip(length).collect();
    }
    kept.append(&mut rest);
    (kept, children)
}

fn length_of_item(tokens: &[Token]) -> usize {
    let mut depth = 0;
    for (at, token) in tokens.iter().enumerate() {
        match token.text.as_str() {
            ";" if depth == 0 => return at + 1,
            "}" if depth == 1 => return at + 1,
            "{" | "(" | "[" => depth += 1,
            "}" | ")" | "]" => depth -= 1,
            _ => {}
        }
    }
    tokens.len()
}

/// Expands a path or a tree such as `a::{B, c::D as E}` that begins at a token; returns what follows it.
fn expand(tokens: &[Token], mut at: usize, base: &mut Vec<String>, found: &mut Vec<Use>) -> usize {
    let text = |at: usize| tokens.get(at).map_or("", |token: &Token| token.text.as_str());
    let depth = base.len();
    if text(at) == "{" {
        at += 1;
        while !matches!(text(at), "}" | "") {
            at = expand(tokens, at, base, found);
            at += usize::from(text(at) == ",");
        }
        return at + 1;
    }
    if !matches!(text(at), "self" | "*") {
        base.push(text(at).to_owned());
    }
    let line = tokens.get(at).map_or(0, |token| token.line);
    at += 1;
    let goes_on = text(at) == "::" && !matches!(text(at + 1), "<" | "");
    if goes_on {
        at = expand(tokens, at + 1, base, found);
    } else {
        let is_renamed = text(at) == "as";
        let name = if is_renamed { text(at + 1).to_owned() } else { base.last().cloned().unwrap_or_default() };
        at += if is_renamed { 2 } else { 0 };
        found.push(Use { line, path: base.clone(), name });
    }
    base.truncate(depth);
    at
}
