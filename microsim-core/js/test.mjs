// Tests of the package in node: node test.mjs PACKAGE GOLDEN [MICROSIM]     MICROSIM: the command line, for its times beside
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import path from "node:path";
import { pathToFileURL } from "node:url";

const [folder, golden, native] = process.argv.slice(2);
const { load } = await import(pathToFileURL(path.resolve(folder, "index.js")));
const microsim = await load();
const programs = ["microsim.wasm", "microsim-simd.wasm"];
const [narrow, wide] = await Promise.all(programs.map((name) => load(fs.readFileSync(path.join(folder, name)))));

// The compiler makes vector instructions of the kernels only at opt-level 3; at 2 they are there by the dozen, and steps take four times
// as long.
const MULTIPLY = Buffer.from([0xfd, 0xe6, 0x01]); // f32x4.mul
const products = programs.map((name) => fs.readFileSync(path.join(folder, name)).toString("latin1").split(MULTIPLY.toString("latin1")).length - 1);
assert(products[0] === 0 && products[1] > 500, `products of four numbers: ${products}`);

assert(microsim.builtins.includes("hunt"));
assert.throws(() => microsim.open("nonsense"), /no built-in scenario "nonsense"/);
assert.throws(() => microsim.open("schema = 1\nname = \"a\"\nfood = 1\n"), /food/);

/** The digest of a built-in scenario after 300 steps, and the median time of a step, ms. */
function run(program, name) {
    const world = program.open(name);
    const times = Array.from({ length: 300 }, () => {
        const began = performance.now();
        world.step();
        return performance.now() - began;
    });
    for (const { surface, disc } of world.organisms) {
        assert((surface ?? Object.values(disc)).every(Number.isFinite));
    }
    const { digest } = world;
    world.close();
    return { digest, time: times.sort((a, b) => a - b)[150] };
}

/** The same time of the native program. */
function nativeTime(name) {
    const output = execFileSync(native, ["bench", name, "--steps", "300", "--warmup", "0", "--json", "--quiet"]);
    return JSON.parse(output).step_ms.median;
}

console.log(`    ms a step, without and with 128-bit instructions${native ? ", and native" : ""}:`);
for (const name of microsim.builtins) {
    const [, expected] = /^step 300 .*digest ([0-9a-f]{16})$/m.exec(fs.readFileSync(path.join(golden, `${name}.txt`), "utf8"));
    const found = [narrow, wide].map((program) => run(program, name));
    found.forEach(({ digest }, k) => assert.equal(digest, expected, `${name} with ${programs[k]}`));
    const times = found.map(({ time }) => time).concat(native ? nativeTime(name) : []);
    console.log(`    ${name.padEnd(14)} ${times.map((time) => time.toFixed(3).padStart(8)).join("")}`);
}

const world = microsim.open("game", { seed: 7 });
const place = () => world.organisms.find(({ index }) => index === world.player).surface[0];
const before = place();
assert(world.steer(world.player, { x: world.width, y: world.height / 2 }));
assert(!world.steer(world.player, { x: NaN, y: 0 }) && !world.steer(999_999, { x: 0, y: 0 }));
world.step(120);
assert(place() > before + 2, `${before} -> ${place()}`);
assert(Math.abs(world.time - 2) < 0.01);
console.log(`${microsim.builtins.length} digests equal with both programs; package tests passed`);
