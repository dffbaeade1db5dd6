// Loads the game, and connects the page's own buttons with it.

import { digest, fail, files, functions, give, held, isScene, kept, pressed, readAddress, say, water } from "./host.js";
import { linkTo, linked } from "./link.js";
import { restorable } from "./restore.js";

const element = (id) => document.getElementById(id);
const canvasElement = element("glcanvas");

/** A program of one 128-bit instruction, which only browsers that have those accept. */
const WIDE = new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 8, 1, 6, 0, 65, 0, 253, 17, 11]);
const isWide = globalThis.WebAssembly?.validate(WIDE) && new URLSearchParams(location.search).get("simd") !== "no";
/** How long to wait for the graphics to come back, ms. */
const TIMEOUT = 5000;
const PROGRAM = isWide ? "game-simd.wasm" : "game.wasm";

/** A response whose reading moves the progress bar. */
function counted(response) {
    const { bytes, simdBytes } = document.documentElement.dataset;
    const total = Number(isWide ? simdBytes : bytes) || 4e6;
    let done = 0;
    const counter = new TransformStream({
        transform(chunk, controller) {
            done += chunk.length;
            element("progress").value = done / total;
            controller.enqueue(chunk);
        },
    });
    return new Response(response.body.pipeThrough(counter), { headers: { "content-type": "application/wasm" } });
}

/** Files of the address as the command line names them. */
async function readLink() {
    const words = [];
    const found = await linked().catch((error) => {
        throw new Error(`the link is damaged: ${error.message}`);
    });
    for (const [kind, bytes] of found) {
        const [name, word] = kind === "replay" ? ["linked.replay", "--replay=linked.replay"] : ["linked.toml", "linked.toml"];
        files.set(name, bytes);
        words.push(word);
    }
    return words;
}

/** As the loader's own `load`, but with progress, and with errors on the page. */
async function load(path) {
    const response = await fetch(path);
    if (!response.ok) throw new Error(`${path}: ${response.status}`);
    Object.assign(importObject.env, functions, { init_webgl: openContext });
    const program = await WebAssembly.compileStreaming(counted(response));
    add_missing_functions_stabs(program);
    const instance = await WebAssembly.instantiate(program, importObject);
    wasm_memory = instance.exports.memory;
    wasm_exports = instance.exports;
    if (wasm_exports.crate_version() !== version) throw new Error("gl.js is not that of this program");
    if (wasm_exports.microsim_crate_version() !== 1) throw new Error("host.js is not that of this program");
    wasm_exports.main();
}

let restore = null;

/** As the loader's own, with a context that can be lost. */
function openContext(version) {
    init_webgl(version);
    ({ gl, restore } = restorable(gl));
}

/** Holds the game while the browser has taken the graphics away, and goes on when they are back; a round pauses then. */
function survive() {
    const frame = animation;
    let waiting;
    canvasElement.addEventListener("webglcontextlost", (event) => {
        event.preventDefault();
        animation = () => {};
        waiting = setTimeout(() => fail(say("The graphics were taken away, as after sleep.")), TIMEOUT);
    });
    canvasElement.addEventListener("webglcontextrestored", () => {
        clearTimeout(waiting);
        restore();
        wasm_exports.focus(false);
        wasm_exports.focus(true);
        element("failure").hidden = true;
        animation = frame;
        requestAnimationFrame(frame);
    });
}

function connectFiles() {
    element("open").onclick = () => element("files").click();
    element("files").onchange = async (event) => {
        await give(event.target.files);
        event.target.value = "";
        element("menu").open = false;
    };
    // Before the loader's own, which cannot read names that are not ASCII.
    addEventListener("drop", (event) => {
        event.preventDefault();
        event.stopImmediatePropagation();
        give(event.dataTransfer.files);
    }, true);
}

/** Copies the link that a promise is of, or says why there is none. */
async function copyLink(promise) {
    try {
        const link = await promise;
        const isCopied = await navigator.clipboard?.writeText(link).then(() => true, () => false);
        if (!isCopied) history.replaceState(null, "", link);
        element("told").textContent = say(isCopied ? "The link is copied." : "The link is in the address bar.");
    } catch (error) {
        element("told").textContent = error.message;
    }
}

function connectLinks() {
    element("menu").ontoggle = () => {
        element("told").textContent = "";
        element("share").hidden = kept("last-game.replay") === null;
        element("share-water").hidden = water === null;
        element("share-scenario").hidden = lastScenario() === undefined;
    };
    const lastGame = async () => Uint8Array.from(atob(kept("last-game.replay")), (letter) => letter.charCodeAt(0));
    element("share").onclick = () => copyLink(lastGame().then((record) => linkTo("replay", record)));
    element("share-water").onclick = () => copyLink(`${location.origin}${location.pathname}?${water}`);
    element("share-scenario").onclick = () => copyLink(linkTo("scenario", files.get(lastScenario())));
}

const lastScenario = () => [...files.keys()].findLast((name) => name.endsWith(".toml"));

/** Buttons for fingers. */
function connectButtons() {
    for (const button of document.querySelectorAll("#buttons button")) {
        const { hold, press } = button.dataset;
        button.onpointerdown = (event) => {
            button.setPointerCapture(event.pointerId);
            if (hold) held.add(hold);
            if (press) pressed.push(press);
        };
        button.onpointerup = button.onpointercancel = () => held.delete(hold);
        button.oncontextmenu = (event) => event.preventDefault();
        // The keyboard stays with the game; keys on a button that has it still press it.
        button.onmousedown = (event) => event.preventDefault();
        button.onclick = (event) => {
            if (event.detail === 0) pressed.push(hold ?? press);
        };
    }
}

/** A touch that the system takes away ends; the loader leaves it held. */
function connectTouches() {
    canvasElement.addEventListener("touchcancel", (event) => {
        for (const { identifier } of event.changedTouches) wasm_exports.touch(SAPP_EVENTTYPE_TOUCHES_ENDED, identifier, 0, 0);
    });
}

function connectKeys() {
    // Full screen and pictures are the game's, not the browser's.
    canvasElement.addEventListener("keydown", (event) => {
        if (event.code === "F11" || event.code === "F12") event.preventDefault();
        // From a menu the key goes on through the page; in a scene it is the game's.
        if (event.code === "Tab" && !isScene && !element("items").hidden) event.stopImmediatePropagation();
    });
    // The right button lunges.
    canvasElement.oncontextmenu = (event) => event.preventDefault();
    canvasElement.addEventListener("pointerdown", () => {
        element("menu").open = false;
        canvasElement.focus();
    });
}

function watch() {
    addEventListener("error", (event) => fail(event.message));
    addEventListener("unhandledrejection", (event) => fail(String(event.reason)));
    element("reload").onclick = () => location.reload();
}

watch();
connectFiles();
connectLinks();
connectButtons();
connectTouches();
connectKeys();
survive();
if (document.createElement("canvas").getContext("webgl2") === null) {
    fail("This browser has no WebGL 2, or it is switched off.");
} else {
    try {
        readAddress(await readLink());
        await load(PROGRAM);
        requestAnimationFrame(() => (element("loading").hidden = true));
    } catch (error) {
        fail(error.message);
    }
}
globalThis.microsim = { digest, linkTo };
navigator.serviceWorker?.register(`offline.js?${PROGRAM}`).catch(() => {}); // Without it the page needs the network, and nothing else.
