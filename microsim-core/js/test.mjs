// Tests of the package in node: node test.mjs PACKAGE GOLDEN
import assert from "node:assert/strict";
import fs from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [folder, golden] = process.argv.slice(2);
const { load } = await import(pathToFileURL(path.resolve(folder, "index.js")));
const microsim = await load();

assert(microsim.builtins.includes("hunt"));
assert.throws(() => microsim.open("nonsense"), /no built-in scenario "nonsense"/);
assert.throws(() => microsim.open("schema = 1\nname = \"a\"\nfood = 1\n"), /food/);

for (const name of microsim.builtins) {
    const world = microsim.open(name);
    world.step(300);
    const [, expected] = /^step 300 .*digest ([0-9a-f]{16})$/m.exec(fs.readFileSync(path.join(golden, `${name}.txt`), "utf8"));
    assert.equal(world.digest, expected, name);
    for (const { surface, disc } of world.organisms) {
        assert((surface ?? Object.values(disc)).every(Number.isFinite));
    }
    world.close();
}

const world = microsim.open("game", { seed: 7 });
const place = () => world.organisms.find(({ index }) => index === world.player).surface[0];
const before = place();
assert(world.steer(world.player, { x: world.width, y: world.height / 2 }));
assert(!world.steer(world.player, { x: NaN, y: 0 }) && !world.steer(999_999, { x: 0, y: 0 }));
world.step(120);
assert(place() > before + 2, `${before} -> ${place()}`);
assert(Math.abs(world.time - 2) < 0.01);
console.log(`${microsim.builtins.length} digests equal; package tests passed`);
