// The service worker of the page on a server: stores the page for visits without a network. Page and program have the same version.
const OURS = "stargrip-cam-";
const CACHE = OURS + "{{VERSION}}";
const FILES = ["./", "stargrip-cam.wasm", "stargrip-cam.webmanifest", "icon.svg"];

self.addEventListener("install", (event) => event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll(FILES))));

self.addEventListener("activate", (event) => {
    const old = (names) => names.filter((name) => name.startsWith(OURS) && name !== CACHE);
    event.waitUntil(caches.keys().then((names) => Promise.all(old(names).map((name) => caches.delete(name)))));
});

self.addEventListener("fetch", (event) => {
    const asked = event.request.mode === "navigate" ? "./" : event.request;
    event.respondWith(caches.open(CACHE).then(async (cache) => (await cache.match(asked)) ?? fetch(event.request)));
});
