// Worlds of microsim in node and browsers. See README.md.

const KINDS = ["rigid_cell", "amoeboid_cell", "platelet", "agar", "probe", "fluid_block", "custom", "red_cell", "coccus", "bacillus"];

/** A program of one 128-bit instruction, which only engines that have those accept. */
const WIDE = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 8, 1, 6, 0, 65, 0, 253, 17, 11]);

/** Loads the program; `source` is its bytes, a response or a promise of one. Without it a file beside this one is read. */
export async function load(source) {
    const { instance } = await instantiate(await (source ?? nearby()));
    return new Microsim(instance.exports);
}

async function nearby() {
    const place = new URL(WebAssembly.validate(WIDE) ? "microsim-simd.wasm" : "microsim.wasm", import.meta.url);
    if (place.protocol !== "file:") return fetch(place);
    const { readFile } = await import("node:fs/promises");
    return readFile(place);
}

const instantiate = (source) =>
    typeof Response !== "undefined" && source instanceof Response
        ? source.arrayBuffer().then((bytes) => WebAssembly.instantiate(bytes))
        : WebAssembly.instantiate(source);

/** The loaded program, which opens scenarios. */
class Microsim {
    #program;

    constructor(program) {
        this.#program = program;
    }

    /** Names of the built-in scenarios. */
    get builtins() {
        this.#program.builtins();
        return received(this.#program).split("\n");
    }

    /** Opens a built-in scenario by its name, or a scenario by its text. */
    open(scenario, { seed } = {}) {
        const bytes = new TextEncoder().encode(scenario);
        const at = this.#program.buffer(bytes.length);
        new Uint8Array(this.#program.memory.buffer).set(bytes, at);
        const run = this.#program.open(seed ?? -1);
        if (run < 0) throw new Error(received(this.#program));
        return new World(this.#program, run);
    }
}

/** A running world. `close` frees it. */
class World {
    #program;
    #run;

    constructor(program, run) {
        this.#program = program;
        this.#run = run;
        this.width = program.width(run);
        this.height = program.height(run);
    }

    step(count = 1) {
        this.#program.step(this.#run, count);
    }

    /** Simulated time, s. */
    get time() {
        return this.#program.time(this.#run);
    }

    /** Index of the player's organism, or undefined. */
    get player() {
        const index = this.#program.player(this.#run);
        return index < 0 ? undefined : index;
    }

    /** Digest of the state: equal worlds have equal ones, on every platform. */
    get digest() {
        return BigInt.asUintN(64, this.#program.digest(this.#run)).toString(16).padStart(16, "0");
    }

    /** Tells an organism where to go, from now on; without a goal, to stay. Returns whether it could be told. */
    steer(organism, goal, { digests = false } = {}) {
        const told = goal
            ? this.#program.steer(this.#run, organism, goal.x, goal.y, digests)
            : this.#program.rest(this.#run, organism, digests);
        return told !== 0;
    }

    /** All organisms: index, kind, and a surface of points x, y, ... or a disc. */
    get organisms() {
        this.#program.organisms(this.#run);
        const words = new Float32Array(bytes(this.#program).slice().buffer);
        const found = [];
        for (let at = 0; at < words.length;) {
            const [index, kind, count] = words.subarray(at, at + 3);
            const length = count === 0 ? 3 : 2 * count;
            const numbers = words.subarray(at + 3, at + 3 + length);
            const shape = count === 0 ? { disc: { x: numbers[0], y: numbers[1], radius: numbers[2] } } : { surface: numbers };
            found.push({ index, kind: KINDS[kind] ?? "unknown", ...shape });
            at += 3 + length;
        }
        return found;
    }

    close() {
        this.#program.close(this.#run);
    }
}

const bytes = (program) => new Uint8Array(program.memory.buffer, program.buffer(program.buffer_length()), program.buffer_length());
const received = (program) => new TextDecoder().decode(bytes(program));
