// The page around the program: dropped files, downloads, settings and unsaved work in the browser's storage, scenes in
// the address.
"use strict";

const state = document.getElementById("state");
const embedded = window !== window.top;  // by tendril-view.js; such a page keeps nothing

function tendrilFailed(text) { state.textContent = text; }
function tendrilReady() { state.textContent = ""; document.getElementById("canvas").focus(); }

// Storage has the JSON files of the program's folder: "tendril/settings.json". It is written at once, so that a page
// that closes loses nothing. An autosave has the number of its page, where the program has that of its process, and
// belongs to that page while the page lives.
const folder = "/home/web_user/.config/tendril", prefix = "tendril/", ownProcess = 42;
const pageNumber = 1 + Math.floor(Math.random() * 1e9);
const known = new Set();  // entries that this page has read or written

async function takeKeptFiles() {
    const lock = (number) => `tendril ${number}`;
    const hold = (number) => navigator.locks?.request(lock(number), () => new Promise(() => {}));  // until the page ends
    hold(pageNumber);
    const held = async () => new Set(((await navigator.locks?.query())?.held ?? []).map((each) => each.name));
    let living = await held();
    if (living.size > 1) {  // a page that this one replaces lets go a moment later
        await new Promise((done) => setTimeout(done, 300));
        living = await held();
    }
    FS.mkdirTree(folder);
    for (const key of Object.keys(localStorage).filter((each) => each.startsWith(prefix))) {
        const number = /autosave-(\d+)/.exec(key)?.[1];
        if (number && living.has(lock(number))) continue;
        if (number) hold(number);  // another tab is not offered it too
        FS.writeFile(`${folder}/${key.slice(prefix.length)}`, localStorage[key]);
        known.add(key);
    }
}

function keepFiles() {
    if (embedded) return;
    const now = new Set();
    try {
        for (const name of FS.readdir(folder).filter((each) => each.endsWith(".json"))) {
            const key = prefix + name.replace(`autosave-${ownProcess}`, `autosave-${pageNumber}`);
            const text = FS.readFile(`${folder}/${name}`, {encoding: "utf8"});
            now.add(key);
            if (localStorage[key] !== text) localStorage[key] = text;
        }
    } catch (error) {
        console.warn(`not all is kept: ${error}`);  // a scene that is larger than the storage
    }
    for (const key of known) if (!now.has(key)) localStorage.removeItem(key);
    known.clear();
    for (const key of now) known.add(key);
}

function leave() {
    if (embedded || !Module.calledRun) return;
    Module.ccall("tendril_keep");
    keepFiles();
}
setInterval(() => { if (Module.calledRun) keepFiles(); }, 5000);
addEventListener("pagehide", leave);
addEventListener("visibilitychange", () => { if (document.hidden) leave(); });

// Downloads each file that the program saves, except its settings and unsaved work.
function tendrilDownload(path) {
    if (path.startsWith(`${folder}/`)) return;
    const link = document.createElement("a");
    link.href = URL.createObjectURL(new Blob([FS.readFile(path)]));
    link.download = path.split("/").pop();
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

// Stores a file from the user and opens it in the program.
function handOver(name, bytes) {
    FS.mkdirTree("/files");
    const path = `/files/${name.replaceAll("/", "_")}`;
    FS.writeFile(path, bytes);
    Module.ccall("tendril_drop", null, ["string"], [path]);
}

const longestAddress = 8000;  // bytes; what mail and chat programs pass on whole
let addresses = 0;

// The address holds the open lab's scene, so that it can be sent to others. A scene that does not fit leaves the address
// without one, never with an older one.
async function tendrilAddress(text) {
    const turn = ++addresses;
    const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("deflate-raw"));
    const packed = new Uint8Array(await new Response(stream).arrayBuffer());
    if (turn !== addresses) return;  // a newer scene is on its way
    const fits = packed.length * 4 / 3 < longestAddress;
    const base64 = fits ? btoa(String.fromCharCode(...packed)) : "";
    const link = base64.replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
    history.replaceState(null, "", fits ? `#scene=${link}` : location.pathname + location.search);
}

// "#scene=..." is the text of a scene, a trace or another file that the program opens: deflated (RFC 1951), in base64
// with - and _ for + and /.
async function fileOfAddress() {
    const found = /^#scene=([\w-]+)$/.exec(location.hash);
    if (!found) return null;
    const deflated = Uint8Array.from(atob(found[1].replaceAll("-", "+").replaceAll("_", "/")), (c) => c.charCodeAt(0));
    const plain = new Blob([deflated]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
    return new Uint8Array(await new Response(plain).arrayBuffer());
}

async function handOverAll(files) {
    for (const file of files) handOver(file.name, new Uint8Array(await file.arrayBuffer()));
}

// The browser's own dialog; it opens only soon after a click or a key.
const chooser = document.getElementById("chooser");
function tendrilChoose() {
    chooser.value = "";  // the same file may be chosen again
    chooser.click();
}
chooser.addEventListener("change", () => handOverAll(chooser.files));

addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", (event) => {
    event.preventDefault();
    handOverAll(event.dataTransfer.files);
});
addEventListener("paste", (event) => {
    const text = event.clipboardData.getData("text/plain");
    if (text) Module.ccall("tendril_paste", null, ["string"], [text]);
});
addEventListener("contextmenu", (event) => event.preventDefault());

var Module = {
    canvas: document.getElementById("canvas"),
    arguments: ["", ""],  // a file to open, and a lab
    preRun: [async () => {
        addRunDependency("files");
        if (embedded) ENV.HOME = "";
        try {
            if (!embedded) await takeKeptFiles();
        } catch (error) {
            console.warn(`no settings are kept here: ${error}`);
        }
        try {
            const file = await fileOfAddress();
            if (file) {
                FS.mkdirTree("/files");
                FS.writeFile("/files/link", file);
                Module.arguments[0] = "/files/link";
            }
        } catch (broken) {
            console.warn(`the address holds no scene: ${broken}`);
        }
        Module.arguments[1] = /^#lab=(\w+)$/.exec(location.hash)?.[1] ?? "";
        removeRunDependency("files");
    }],
    setStatus: (text) => { if (text) state.textContent = text; },
    onAbort: (why) => tendrilFailed(`Tendril stopped: ${why}. Reload the page; unsaved work is offered then.`),
};
