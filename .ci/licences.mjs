// Prints the licences of everything that programs are built from, each text once.
//
//   cargo metadata --locked --format-version 1 --filter-platform TARGET | node .ci/licences.mjs PACKAGE...

import { readFileSync, readdirSync } from "node:fs";
import { dirname, join } from "node:path";

const { packages, resolve } = JSON.parse(readFileSync(0));
const byId = new Map(packages.map((it) => [it.id, it]));
const nodes = new Map(resolve.nodes.map((it) => [it.id, it]));

/** Packages that are linked, and data that roots take in while they are built. */
const found = new Set();
const visit = (id, kinds) => {
    if (found.has(id)) return;
    found.add(id);
    const isLinked = ({ dep_kinds }) => dep_kinds.some(({ kind }) => kinds.includes(kind));
    for (const dep of nodes.get(id).deps.filter(isLinked)) visit(dep.pkg, [null]);
};
for (const name of process.argv.slice(2)) visit(packages.find((it) => it.name === name).id, [null, "build"]);

const texts = new Map();
const label = ({ name, version, license }) => `${name} ${version} (${license ?? "see below"})`;
for (const id of [...found].sort()) {
    const it = byId.get(id);
    if (it.source === null) continue;
    const folder = dirname(it.manifest_path);
    const isLicence = (name) => /^(licen[cs]e|copying|notice|unlicense|ufl|ofl)/i.test(name) && !name.endsWith(".rs");
    const files = readdirSync(folder, { withFileTypes: true, recursive: true }).filter((file) => file.isFile() && isLicence(file.name));
    const found = files.map((file) => readFileSync(join(file.parentPath ?? file.path, file.name), "utf8").trim()).sort();
    if (found.length === 0) found.push("The package has no text of its licence.");
    for (const text of new Set(found)) texts.set(text, [...(texts.get(text) ?? []), label(it)]);
}
for (const [text, users] of texts) console.log(`${users.join("\n")}\n\n${text}\n\n${"-".repeat(80)}\n`);
