// Scenarios and replays in the part of an address after `#`, which browsers do not send: compressed, in base64url.

const LONGEST = 1 << 20;

const tooMuch = () => new Error("the link has too much in it");

async function through(stream, bytes) {
    const reader = new Blob([bytes]).stream().pipeThrough(stream).getReader();
    const parts = [];
    for (let length = 0, part; !(part = await reader.read()).done; parts.push(part.value)) {
        length += part.value.length;
        if (length > LONGEST) throw tooMuch();
    }
    return new Uint8Array(await new Blob(parts).arrayBuffer());
}

/** The address of this page with a file in it. */
export async function linkTo(kind, bytes) {
    if (bytes.length > LONGEST) throw tooMuch();
    const packed = await through(new CompressionStream("deflate-raw"), bytes);
    const text = btoa(Array.from(packed, (byte) => String.fromCharCode(byte)).join(""));
    const safe = text.replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
    return `${location.origin}${location.pathname}#${kind}=${safe}`;
}

/** The files in the address of this page, by kind. */
export async function linked() {
    const found = new Map();
    for (const [kind, safe] of new URLSearchParams(location.hash.slice(1).replaceAll("+", "-"))) {
        const text = atob(safe.replaceAll("-", "+").replaceAll("_", "/"));
        const packed = Uint8Array.from(text, (letter) => letter.charCodeAt(0));
        found.set(kind, await through(new DecompressionStream("deflate-raw"), packed));
    }
    return found;
}
