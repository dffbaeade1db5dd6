//! Makes the tables that the program reads of the catalogues, which are in the syntax of Project Fluent.

use fluent_syntax::ast::{Entry, Expression, InlineExpression, Message, Pattern, PatternElement, Variant, VariantKey};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::Path;

/// Texts by the name of their message.
type Catalogue = BTreeMap<String, Text>;

/// A text as the table has it, and the variables that it names.
#[derive(Default)]
struct Text {
    table: String,
    variables: BTreeSet<String>,
}

/// The language that has all messages, and stands in every program.
const FIRST: &str = "en";
/// Messages that only other languages have: the texts of slides and of simulations, which are English in their own files.
const OF_SCENES: [&str; 2] = ["slide-", "scene-"];
/// Messages of the page around the game, which has the English ones in its own files.
const OF_PAGE: &str = "page-";

/// Writes `words.rs`, the names of all messages and the tables in the program, and for each language a table and the field guide.
pub(crate) fn compile(out: &Path) {
    println!("cargo::rerun-if-changed=words");
    let english = catalogue(FIRST);
    let is_page = std::env::var("CARGO_CFG_TARGET_ARCH").is_ok_and(|arch| arch == "wasm32");
    let mut code = keys(&english);
    code += "fn builtin(code: &str) -> Option<&'static str> {\nmatch code {\n";
    for language in languages() {
        let own = catalogue(&language);
        check(&english, &own).unwrap_or_else(|problem| panic!("words/{language}.ftl: {problem}"));
        std::fs::write(out.join(format!("{language}.words")), table(&english, &own)).expect("a table is written");
        // A page fetches the others when they are asked for.
        if language == FIRST || !is_page {
            let _ = writeln!(
                code,
                "\"{language}\" => Some(include_str!(concat!(env!(\"OUT_DIR\"), \"/{language}.words\"))),"
            );
        }
    }
    code += "_ => None,\n}\n}\n";
    code += &guides(out, is_page);
    std::fs::write(out.join("words.rs"), code).expect("the names are written");
}

/// Writes the field guide in each language, and returns the function that has those that are in the program: a page fetches all.
fn guides(out: &Path, is_page: bool) -> String {
    let mut code = String::from("fn builtin_guide(code: &str) -> Option<&'static str> {\nmatch code {\n");
    let english = articles(FIRST);
    for language in languages() {
        let own = articles(&language);
        let table: Vec<String> = english
            .iter()
            .map(|(name, [.., source])| {
                let [title, text, _] =
                    own.get(name).unwrap_or_else(|| panic!("words/guide/{language}.ftl: {name} is missing"));
                [name.as_str(), title, text, source].join("\x02")
            })
            .collect();
        assert_eq!(own.len(), english.len(), "words/guide/{language}.ftl: articles that are not in English");
        std::fs::write(out.join(format!("guide-{language}.words")), table.join("\0")).expect("a guide is written");
        if !is_page {
            let path = format!("concat!(env!(\"OUT_DIR\"), \"/guide-{language}.words\")");
            let _ = writeln!(code, "\"{language}\" => Some(include_str!({path})),");
        }
    }
    code + "_ => None,\n}\n}\n"
}

/// Title, text and source of each article in a language; sources are English.
fn articles(language: &str) -> BTreeMap<String, [String; 3]> {
    let path = format!("words/guide/{language}.ftl");
    let source = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let resource =
        fluent_syntax::parser::parse(source.as_str()).unwrap_or_else(|(_, errors)| panic!("{path}: {errors:?}"));
    let mut articles = BTreeMap::new();
    for entry in &resource.body {
        let Entry::Message(message) = entry else { continue };
        let name = message.id.name;
        let article = article(message).unwrap_or_else(|| panic!("{path}: {name} has no title or no text"));
        articles.insert(name.to_owned(), article);
    }
    articles
}

fn article(message: &Message<&str>) -> Option<[String; 3]> {
    let part = |name| message.attributes.iter().find(|part| part.id.name == name);
    let source = part("source").map_or_else(|| Some(String::new()), |source| plain(&source.value));
    Some([plain(message.value.as_ref()?)?, plain(&part("text")?.value)?, source?])
}

/// A text without values.
fn plain(pattern: &Pattern<&str>) -> Option<String> {
    let mut text = Text::default();
    add(pattern, &mut text).ok().filter(|()| text.variables.is_empty())?;
    Some(text.table)
}

/// Names of all files in the folder of texts.
fn languages() -> Vec<String> {
    let entries = std::fs::read_dir("words").expect("the folder of texts is there").flatten();
    let mut names: Vec<String> =
        entries.filter_map(|entry| Some(entry.file_name().to_str()?.strip_suffix(".ftl")?.to_owned())).collect();
    names.sort();
    names
}

fn catalogue(language: &str) -> Catalogue {
    let path = format!("words/{language}.ftl");
    let source = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    read(&source).unwrap_or_else(|problem| panic!("{path}: {problem}"))
}

fn read(source: &str) -> Result<Catalogue, String> {
    let resource = fluent_syntax::parser::parse(source).map_err(|(_, errors)| format!("{errors:?}"))?;
    let mut catalogue = Catalogue::new();
    for entry in resource.body {
        let Entry::Message(message) = entry else { continue };
        let (name, value) = (message.id.name, message.value.ok_or("a message without a text")?);
        let mut text = Text::default();
        add(&value, &mut text).map_err(|problem| format!("{name}: {problem}"))?;
        if catalogue.insert(name.to_owned(), text).is_some() {
            return Err(format!("{name} is there twice"));
        }
    }
    Ok(catalogue)
}

/// Adds a pattern: letters, `\x01` variable `\x02`, and `\x03` variable `\x02` variants `\x05`. A variant is its category, `\x02`,
/// its pattern and `\x04`; the last one has no category, and is for all others.
fn add(pattern: &Pattern<&str>, text: &mut Text) -> Result<(), String> {
    for element in &pattern.elements {
        match element {
            PatternElement::TextElement { value } => text.table.push_str(value),
            PatternElement::Placeable { expression: Expression::Inline(inline) } => {
                let name = variable(inline)?;
                text.variables.insert(name.to_owned());
                let _ = write!(text.table, "\x01{name}\x02");
            }
            PatternElement::Placeable { expression: Expression::Select { selector, variants } } => {
                let name = variable(selector)?;
                text.variables.insert(name.to_owned());
                let _ = write!(text.table, "\x03{name}\x02");
                add_variants(variants, text)?;
            }
        }
    }
    Ok(())
}

fn add_variants(variants: &[Variant<&str>], text: &mut Text) -> Result<(), String> {
    let (usual, others): (Vec<_>, Vec<_>) = variants.iter().partition(|variant| variant.default);
    for variant in others.into_iter().chain(usual) {
        let (VariantKey::Identifier { name } | VariantKey::NumberLiteral { value: name }) = variant.key;
        let _ = write!(text.table, "{}\x02", if variant.default { "" } else { name });
        if variant
            .value
            .elements
            .iter()
            .any(|element| matches!(element, PatternElement::Placeable { expression: Expression::Select { .. } }))
        {
            return Err("a choice within a choice".to_owned());
        }
        add(&variant.value, text)?;
        text.table.push('\x04');
    }
    text.table.push('\x05');
    Ok(())
}

fn variable<'a>(expression: &InlineExpression<&'a str>) -> Result<&'a str, String> {
    match expression {
        InlineExpression::VariableReference { id } => Ok(id.name),
        other => Err(format!("not a variable: {other:?}")),
    }
}

/// Whether a language has the messages of the first one, with the same variables.
fn check(english: &Catalogue, catalogue: &Catalogue) -> Result<(), String> {
    for (name, text) in english {
        let own = catalogue.get(name).ok_or(format!("{name} is missing"))?;
        if own.variables != text.variables {
            return Err(format!("{name} has the variables {:?}, not {:?}", own.variables, text.variables));
        }
    }
    let is_of_scene = |name: &str| OF_SCENES.iter().any(|group| name.starts_with(group));
    let unknown = catalogue.keys().find(|name| !english.contains_key(*name) && !is_of_scene(name));
    unknown.map_or(Ok(()), |name| Err(format!("{name} is unknown")))
}

/// Names of the messages that the program has.
fn names(english: &Catalogue) -> impl Iterator<Item = &String> {
    english.keys().filter(|name| !name.starts_with(OF_PAGE))
}

/// All texts in the order of the names, then those of scenes with their names, then those of the page with the English ones.
fn table(english: &Catalogue, catalogue: &Catalogue) -> String {
    let known = names(english).map(|name| catalogue[name].table.clone());
    let own = catalogue.iter().filter(|(name, _)| !english.contains_key(*name));
    let of_scenes = own.map(|(name, text)| {
        let name = OF_SCENES.iter().find_map(|group| name.strip_prefix(group)).unwrap_or(name);
        format!("{name}\x02{}", text.table)
    });
    let of_page =
        english.iter().filter(|(name, text)| name.starts_with(OF_PAGE) && text.table != catalogue[*name].table);
    let of_page = of_page.map(|(name, text)| format!("{OF_PAGE}\x02{}\x02{}", text.table, catalogue[name].table));
    known.chain(of_scenes).chain(of_page).collect::<Vec<_>>().join("\0")
}

/// The names as an enumeration.
fn keys(english: &Catalogue) -> String {
    let camel = |name: &String| name.split('-').map(|word| word[..1].to_uppercase() + &word[1..]).collect::<String>();
    let keys: Vec<String> = names(english).map(camel).collect();
    let mut code =
        String::from("/// Names of all messages.\n#[derive(Clone, Copy, Debug, PartialEq, Eq)]\npub enum Key {\n");
    for (name, key) in names(english).zip(&keys) {
        let _ = writeln!(code, "/// `{name}`\n{key},");
    }
    let all: Vec<String> = names(english).zip(&keys).map(|(name, key)| format!("(\"{name}\", Key::{key})")).collect();
    let _ = write!(
        code,
        "}}\n/// How many there are.\nconst COUNT: usize = {count};\n#[cfg(test)]\nconst ALL: [(&str, Key); {count}] = [{all}];\n",
        count = keys.len(),
        all = all.join(", "),
    );
    code
}
