/** Loads the program; without a source, `microsim-simd.wasm` or `microsim.wasm` beside this module. */
export function load(source?: BufferSource | Response | Promise<BufferSource | Response>): Promise<Microsim>;

export interface Microsim {
    /** Names of the built-in scenarios. */
    readonly builtins: string[];
    /** Opens a built-in scenario by its name, or a scenario by its text. Throws what is wrong with it. */
    open(scenario: string, options?: { seed?: number }): World;
}

export interface World {
    /** Size of the room, units. */
    readonly width: number;
    readonly height: number;
    /** Simulated time, s. */
    readonly time: number;
    /** Index of the player's organism. */
    readonly player: number | undefined;
    /** Digest of the state, 16 hexadecimal digits: equal worlds have equal ones, on every platform. */
    readonly digest: string;
    /** All organisms, as they are now. */
    readonly organisms: Organism[];
    /** Takes steps, one unless told. */
    step(count?: number): void;
    /** Tells an organism where to go, from now on; without a goal, to stay. Returns whether it could be told. */
    steer(organism: number, goal?: { x: number; y: number }, options?: { digests?: boolean }): boolean;
    /** Frees the world, which is of no use afterwards. */
    close(): void;
}

export interface Organism {
    index: number;
    kind: "rigid_cell" | "amoeboid_cell" | "platelet" | "agar" | "probe" | "fluid_block" | "custom" | "red_cell" | "coccus" | "bacillus" | "unknown";
    /** Points of its surface, counter-clockwise: x, y, x, y, ... in units. */
    surface?: Float32Array;
    /** In place of a surface, for what is a disc. */
    disc?: { x: number; y: number; radius: number };
}
