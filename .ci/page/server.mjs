// A server of static files.
import fs from "node:fs";
import http from "node:http";
import path from "node:path";

const TYPES = { ".css": "text/css", ".html": "text/html", ".js": "text/javascript", ".png": "image/png",
    ".txt": "text/plain", ".wasm": "application/wasm", ".webmanifest": "application/manifest+json" };
/** A port that nobody listens at. */
export function freePort() {
    return new Promise((found) => {
        const probe = http.createServer().listen(0, "127.0.0.1", () => {
            const { port } = probe.address();
            probe.close(() => found(port));
        });
    });
}

/** Serves a folder until the program ends; returns its address. */
export async function serve(folder) {
    const server = http.createServer((request, response) => {
        const name = path.join(folder, path.normalize(new URL(request.url, "http://page").pathname));
        const file = name.endsWith("/") ? `${name}index.html` : name;
        fs.readFile(file, (error, bytes) => {
            response.writeHead(error ? 404 : 200, { "content-type": TYPES[path.extname(file)] ?? "application/octet-stream" });
            response.end(bytes);
        });
    });
    await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
    return `http://127.0.0.1:${server.address().port}/`;
}
