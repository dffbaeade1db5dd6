// What the game asks of the page, and what it tells it: the functions of `src/platform/web`.

import { Mesh } from "./mesh.js";

const STORE = "microsim/";
const LONGEST_FILE = 16 << 20;
/** Seconds by which sound is late, so that a late frame leaves no gap. */
const DELAY = 0.06;

const encode = (text) => new TextEncoder().encode(text);
const decode = (bytes) => new TextDecoder().decode(bytes);
const element = (id) => document.getElementById(id);

/** Files by name that were picked, dropped or part of the address. */
export const files = new Map();
/** Names of buttons that are held, and of those pressed since the game last asked. */
export const held = new Set(), pressed = [];
/** Whether the game shows a scene, in which all keys are its own. */
export let isScene = false;
/** The part of the address after `?` that shows the last water of the food chain. */
export let water = null;

/** Keys that move through menus, as the game calls them. */
const MOVES = { ArrowUp: "up", ArrowDown: "down", ArrowLeft: "left", ArrowRight: "right", Escape: "escape" };

const dropped = [];
const address = new URLSearchParams(location.search);
const words = ["microsim-game"];
let question = "";
/** The item of the menu that was pointed at by keyboard or screen reader, and whether the page follows the game's own focus. */
let item = null, isFollowing = false;

/** Texts of the page in the language of the game, by the English ones. */
const said = new Map();

/** A text of the page in the language of the game. */
export const say = (english) => said.get(english) ?? english;

/** What the page says at first, each with what becomes of the text in another language. */
const texts = [...document.querySelectorAll("*")].flatMap((node) => [
    ...(node.ariaLabel ? [[node.ariaLabel, (text) => (node.ariaLabel = text)]] : []),
    ...[...node.childNodes].filter(({ nodeType }) => nodeType === Node.TEXT_NODE).map((own) => [own.data, (text) => (own.data = text)]),
]);

/** Puts the page into the language of the game. */
function translate(code) {
    said.clear();
    for (const entry of decode(languages.get(code) ?? new Uint8Array()).split("\0")) {
        const [group, english, other] = entry.split("\x02");
        if (group === "page-") said.set(english, other);
    }
    for (const [english, show] of texts) show(english.replace(english.trim(), say));
    document.documentElement.lang = code;
    return true;
}

/** Shows why the game cannot go on. */
export function fail(problem) {
    console.error(problem);
    element("loading").hidden = true;
    element("problem").textContent ||= problem;
    element("failure").hidden = false;
}

/** Hands files to the game as if they were dropped on its window. */
export async function give(list) {
    for (const file of list) {
        // A folder, for one, cannot be read.
        const bytes = file.size <= LONGEST_FILE && (await file.arrayBuffer().catch(() => null));
        if (bytes) {
            files.set(file.name, new Uint8Array(bytes));
            dropped.push(file.name);
        }
    }
}

/** Adds to the command line what the address says: `?scenario=hunt&seed=7` is `hunt --seed=7`. */
export function readAddress(linked) {
    for (const [name, value] of address) {
        if (name === "scenario") words.push(value);
        else if (name !== "direct" && name !== "floats" && name !== "simd") words.push(value === "" ? `--${name}` : `--${name}=${value}`);
    }
    words.push(...linked);
}

/** A value that is kept, as base64; null if there is none. */
export function kept(name) {
    try {
        return localStorage.getItem(STORE + name);
    } catch {
        return null;
    }
}

/** Digest of a scene after some steps, as hexadecimal digits. */
export function digest(scene, steps) {
    question = scene;
    return BigInt.asUintN(64, wasm_exports.microsim_digest(steps)).toString(16).padStart(16, "0");
}

function toBase64(bytes) {
    let text = "";
    for (const byte of bytes) text += String.fromCharCode(byte);
    return btoa(text);
}

const fromBase64 = (text) => Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));

function storageWorks() {
    try {
        return localStorage.length >= 0; // There is something to read, though there may be no room for more.
    } catch {
        return false;
    }
}

function readKept(name) {
    const value = kept(name);
    if (value === null) return null;
    try {
        return fromBase64(value);
    } catch {
        return encode(value); // Not base64: damaged, which the game finds out.
    }
}

function put(name, text) {
    try {
        localStorage.setItem(STORE + name, text);
        return true;
    } catch {
        return false;
    }
}

const keep = (name, bytes) => put(name, toBase64(bytes));

function rename(name, other) {
    const value = kept(name);
    if (value === null) return false;
    localStorage.removeItem(STORE + name); // There may be no room for both.
    return put(decode(other), value) || (put(name, value), false);
}

function download(name, bytes) {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([bytes]));
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
    return true;
}

/** Gives the player a picture as a file: its width and name, and four bytes for each pixel. */
function downloadPicture(what, pixels) {
    const [width, ...name] = what.split(" ");
    const canvas = document.createElement("canvas");
    const picture = new ImageData(new Uint8ClampedArray(pixels), Number(width));
    canvas.width = picture.width;
    canvas.height = picture.height;
    canvas.getContext("2d").putImageData(picture, 0, 0);
    canvas.toBlob((file) => download(name.join(" "), file));
    return true;
}

let audio = null, played = 0;

/** Plays samples after those before, a little later than now: frames come when they come. */
function playSound(rate, bytes) {
    if (!navigator.userActivation?.hasBeenActive) return false; // No browser plays before.
    audio ??= new AudioContext();
    if (audio.state === "suspended") audio.resume();
    const samples = new Float32Array(bytes.buffer);
    if (samples.length === 0) return true;
    const buffer = audio.createBuffer(1, samples.length, Number(rate));
    buffer.copyToChannel(samples, 0);
    const source = audio.createBufferSource();
    source.buffer = buffer;
    source.connect(audio.destination);
    if (played < audio.currentTime) played = audio.currentTime + DELAY;
    source.start(played);
    played += buffer.duration;
    return true;
}

const fingers = matchMedia("(pointer: coarse)");

function showButtons(areWanted, which) {
    isScene = areWanted;
    element("buttons").hidden = !(areWanted && fingers.matches);
    for (const name of ["digest", "divide", "lunge"]) element(name).hidden = !which.split(" ").includes(name);
}

function newItem(k) {
    const button = document.createElement("button");
    button.type = "button";
    button.onfocus = () => (item = isFollowing ? item : k);
    button.onclick = () => {
        item = k;
        pressed.push("enter");
    };
    button.onkeydown = (event) => {
        if (!(event.key in MOVES)) return;
        event.preventDefault();
        pressed.push(MOVES[event.key]);
    };
    return button;
}

/** Puts a menu that the game draws into the page, for screen readers. */
function showMenu(screen, bytes) {
    const group = element("items");
    const [focus, ...labels] = decode(bytes).split("\n");
    const hadFocus = group.contains(document.activeElement);
    while (group.children.length > labels.length) group.lastChild.remove();
    labels.forEach((label, k) => ((group.children[k] ?? group.appendChild(newItem(k))).textContent = label));
    group.ariaLabel = screen || say("Scene");
    group.hidden = labels.length === 0;
    if (hadFocus) {
        isFollowing = true;
        (group.children[focus] ?? element("glcanvas")).focus({ preventScroll: true });
        isFollowing = false;
    }
    return true;
}

/** Connections to rooms by number, with the frames that came since the game last asked, and what those of each member weigh. */
const rooms = new Map();
/** Frames of one member that wait for a game that does not ask, as in a hidden tab: 20 s of a match. More are lost. */
const MOST_FRAMES = 600;
/** What a frame counts: one, and one for each 2 KiB of it. */
const weight = ({ length }) => 1 + (length >> 11);
/** Time after which a game that does not ask leaves the room instead, ms. */
const PAUSE = 15_000;
/** Longest frame, bytes. */
const LONGEST_FRAME = 65537;
/** Bytes that wait to be sent; what is more is lost. */
const MOST_UNSENT = 1 << 20;

function enterRoom(number, code) {
    const socket = new WebSocket(new URL(`room/${decode(code)}`, location.href.replace("http", "ws")));
    const frames = [], counts = new Uint16Array(256), room = { socket, frames, counts, asked: performance.now() };
    const receive = (frame) => {
        const [from] = frame, isLost = from !== 255 && counts[from] >= MOST_FRAMES; // 255: the server.
        const isTooMuch = isLost ? performance.now() - room.asked > PAUSE : frames.length > 5 * MOST_FRAMES;
        if (isTooMuch) return socket.close(4000);
        if (isLost) return;
        counts[from] += weight(frame);
        frames.push(frame);
    };
    const mesh = address.get("direct") === "no" ? null : new Mesh((frame) => submit(socket, frame), receive);
    socket.binaryType = "arraybuffer";
    socket.onmessage = ({ data }) => {
        if (typeof data === "string" || data.byteLength > LONGEST_FRAME) return socket.close(4000);
        const frame = new Uint8Array(data);
        if (!mesh?.take(frame)) receive(frame);
    };
    socket.onclose = () => {
        mesh?.close();
        frames.push(Uint8Array.of(255, 3)); // As if the server had refused, without a reason.
    };
    rooms.set(number, Object.assign(room, { mesh }));
}

function nextFrame(number) {
    const room = rooms.get(number), frame = room.frames.shift();
    room.asked = performance.now();
    if (frame) room.counts[frame[0]] -= weight(frame);
    return frame ?? null;
}

function leaveRoom(number) {
    const { socket, mesh } = rooms.get(number);
    mesh?.close();
    socket.close();
    rooms.delete(number);
}

function submit(socket, frame) {
    if (socket.readyState === WebSocket.OPEN && socket.bufferedAmount < MOST_UNSENT) socket.send(frame);
}

function send(number, frame) {
    const { socket, mesh } = rooms.get(number);
    if (!mesh?.send(frame)) submit(socket, frame);
}

/** Time for other tabs to answer, ms. */
const ANSWER = 1000;

/** A tab that is duplicated duplicates its key: the new one asks the others whether they have it, and then makes one of its own. */
function keepOwnKey() {
    const tabs = new BroadcastChannel("microsim");
    let asked = sessionStorage.roomKey;
    tabs.onmessage = ({ data: { key, isAsked } }) => {
        if (key !== sessionStorage.roomKey) return;
        if (isAsked) tabs.postMessage({ key });
        else if (asked) delete sessionStorage.roomKey;
    };
    if (asked) tabs.postMessage({ key: asked, isAsked: true });
    setTimeout(() => (asked = undefined), ANSWER);
}
try {
    keepOwnKey();
} catch {
    // Storage is forbidden, and each room gets a new key.
}

/** A key that nobody can guess; a page that is loaded again in its tab has the same. */
function roomKey() {
    const bytes = crypto.getRandomValues(new Uint8Array(16));
    const key = Array.from(bytes, (byte) => byte.toString(16).padStart(2, "0")).join("");
    try {
        return encode((sessionStorage.roomKey ??= key));
    } catch {
        return encode(key); // Storage is forbidden.
    }
}

function takeItem() {
    const taken = item;
    item = null;
    return encode(String(taken ?? ""));
}

/** The usual ones among the gamepads, one a line: the stick's axes in hundredths, and numbers of buttons that are down. */
function gamepads() {
    const pads = [...(navigator.getGamepads?.() ?? [])].filter((pad) => pad?.mapping === "standard");
    const down = (pad) => [...pad.buttons.keys()].filter((k) => pad.buttons[k].pressed);
    return encode(pads.map((pad) => [...pad.axes.slice(0, 2).map((share) => Math.round(100 * share)), ...down(pad)].join(" ")).join("\n"));
}

function hasFloatTargets() {
    const extension = gl.getExtension("EXT_color_buffer_float") ?? gl.getExtension("EXT_color_buffer_half_float");
    return extension && address.get("floats") !== "no" ? encode("") : null;
}

/** Time after which texts that did not come are asked for again, ms. */
const RETRY = 5000;
/** Texts by language, fetched when the game asks; null on the way. */
const languages = new Map();

function wordsOf(code) {
    if (!languages.has(code)) {
        languages.set(code, null);
        fetch(`${code}.words`)
            .then(async (answer) => (answer.ok ? languages.set(code, new Uint8Array(await answer.arrayBuffer())) : Promise.reject()))
            .catch(() => setTimeout(() => languages.delete(code), RETRY)); // Until then the texts stay as they are.
    }
    return languages.get(code);
}

const answers = {
    "arguments": () => encode(words.join("\n")),
    "asked": () => encode(question),
    "covered height": () => encode(String(element("buttons").offsetHeight)),
    "dropped": () => encode(dropped.splice(0).join("\n")),
    "file": (name) => files.get(name) ?? null,
    "float targets": hasFloatTargets,
    "gamepads": gamepads,
    "has storage": () => (storageWorks() ? encode("") : null),
    "item": takeItem,
    "locale": () => encode(navigator.language),
    "held": () => encode([...held].join("\n")),
    "kept": readKept,
    "words": wordsOf,
    "room": nextFrame,
    "room key": roomKey,
    "pressed": () => encode(pressed.splice(0).join("\n")),
};

const orders = {
    "download": download,
    "enter room": enterRoom,
    "fail": (_, bytes) => fail(decode(bytes)),
    "hide buttons": (which) => showButtons(false, which),
    "keep": keep,
    "language": translate,
    "leave room": leaveRoom,
    "offer": (query) => ((water = query), true),
    "picture": downloadPicture,
    "print": (_, bytes) => console.log(decode(bytes)),
    "rename": rename,
    "send": send,
    "show buttons": (which) => showButtons(true, which),
    "show menu": showMenu,
    "sound": playSound,
};

let found = new Uint8Array();
const bytesAt = (at, length) => new Uint8Array(wasm_memory.buffer, at, length).slice();
const textAt = (at, length) => decode(bytesAt(at, length));

/** Functions that the program imports; the loader's own are there already. */
export const functions = {
    microsim_now: () => performance.now(),
    microsim_ask(what, whatLength, name, nameLength) {
        found = answers[textAt(what, whatLength)](textAt(name, nameLength));
        return found === null ? -1 : found.length;
    },
    microsim_take: (to) => new Uint8Array(wasm_memory.buffer).set(found, to),
    microsim_tell(what, whatLength, name, nameLength, bytes, length) {
        return orders[textAt(what, whatLength)](textAt(name, nameLength), bytesAt(bytes, length)) ? 1 : 0;
    },
    // The loader asks for the canvas alone, which hides the buttons, and lets a refusal become an error.
    sapp_set_fullscreen(isWanted) {
        const change = isWanted ? document.documentElement.requestFullscreen?.() : document.exitFullscreen?.();
        change?.catch(() => {});
    },
};
