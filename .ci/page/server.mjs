// A server of static files, and that of rooms.
import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { once } from "node:events";
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

/** Serves a folder until the program ends, with these headers too; returns its address. */
export async function serve(folder, headers = {}) {
    const server = http.createServer((request, response) => {
        const name = path.join(folder, path.normalize(new URL(request.url, "http://page").pathname));
        const file = name.endsWith("/") ? `${name}index.html` : name;
        fs.readFile(file, (error, bytes) => {
            response.writeHead(error ? 404 : 200, { "content-type": TYPES[path.extname(file)] ?? "application/octet-stream", ...headers });
            response.end(bytes);
        });
    });
    await new Promise((ready) => server.listen(0, "127.0.0.1", ready));
    return `http://127.0.0.1:${server.address().port}/`;
}

/** Starts the server of rooms, which serves a folder too; returns it and the address of a room. */
export async function serveRooms(program, folder, ...options) {
    const server = spawn(program, ["--quiet", "serve", "--port", "0", "--listen", "127.0.0.1", "--page", folder, ...options],
        { stdio: ["ignore", "pipe", "inherit"] });
    const [line] = await Promise.race([once(server.stdout, "data"), once(server, "exit").then(() => assert.fail("there is no server"))]);
    return { server, address: new URL(String(line).trim()) };
}
