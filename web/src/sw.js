// Keeps the page's files, so that it works offline.
const version = 'VERSION';
const files = FILES;

addEventListener('install', (event) => event.waitUntil(caches.open(version).then((cache) => cache.addAll(files)).then(() => skipWaiting())));
addEventListener('activate', (event) => event.waitUntil(
  caches.keys().then((keys) => Promise.all(keys.filter((key) => key !== version).map((key) => caches.delete(key))))));
addEventListener('fetch', (event) => event.respondWith(
  caches.match(event.request, { ignoreSearch: true }).then((kept) => kept ?? fetch(event.request))));
