// Keeps the page for when there is no network. `@VERSION@` is a hash of all files: another version is another cache.

const CACHE = "microsim-@VERSION@";
// Of the two programs the one that this browser runs; pages of before did not say.
const PROGRAM = location.search.slice(1) || "game.wasm";
const FILES = ["./", "start.js", "host.js", "mesh.js", "link.js", "restore.js", "gl.js", "style.css", PROGRAM, "manifest.webmanifest", "icon-192.png", "@WORDS@"];

// Nothing older than the server's, whatever the browser has kept by itself, and not used as long as a page of another version is open: parts of two versions do
// not fit together.
addEventListener("install", (event) => {
    const requests = FILES.map((file) => new Request(file, { cache: "no-cache" }));
    event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll(requests)));
});

addEventListener("activate", (event) => {
    const isOld = (name) => name.startsWith("microsim-") && name !== CACHE;
    event.waitUntil(caches.keys().then((names) => Promise.all(names.filter(isOld).map((name) => caches.delete(name)))));
});

addEventListener("fetch", (event) => {
    if (event.request.method !== "GET") return;
    event.respondWith(caches.open(CACHE)
        .then((cache) => cache.match(event.request.url.replace("/index.html", "/"), { ignoreSearch: true }))
        .then((kept) => kept ?? fetch(event.request)));
});
