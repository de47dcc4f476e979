// The page around the program: dropped files, downloads, settings in the browser's storage, scenes in the address.
"use strict";

const kept = "/home/web_user";  // lives in the browser's storage
const state = document.getElementById("state");

function tendrilFailed(text) { state.textContent = text; }
function tendrilReady() { state.textContent = ""; document.getElementById("canvas").focus(); }

function tendrilKeepFiles() {
    FS.syncfs(false, (error) => { if (error) console.warn(`settings are not kept: ${error}`); });
}

// Downloads each file that the program saves, except its settings and unsaved work.
function tendrilDownload(path) {
    if (path.startsWith(`${kept}/.config/`)) return;
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

// "#scene=..." is a scene's text: deflated, in base64 with - and _ for + and /.
async function sceneOfAddress() {
    const found = /^#scene=([\w-]+)$/.exec(location.hash);
    if (!found) return null;
    const deflated = Uint8Array.from(atob(found[1].replaceAll("-", "+").replaceAll("_", "/")), (c) => c.charCodeAt(0));
    const plain = new Blob([deflated]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
    return new Uint8Array(await new Response(plain).arrayBuffer());
}

// The browser's own dialog; it opens only soon after a click or a key.
function tendrilChoose() {
    const input = document.createElement("input");
    input.type = "file";
    input.onchange = async () => { for (const file of input.files) handOver(file.name, new Uint8Array(await file.arrayBuffer())); };
    input.click();
}

addEventListener("dragover", (event) => event.preventDefault());
addEventListener("drop", async (event) => {
    event.preventDefault();
    for (const file of event.dataTransfer.files) handOver(file.name, new Uint8Array(await file.arrayBuffer()));
});
addEventListener("paste", (event) => {
    const text = event.clipboardData.getData("text/plain");
    if (text) Module.ccall("tendril_paste", null, ["string"], [text]);
});
addEventListener("contextmenu", (event) => event.preventDefault());
addEventListener("visibilitychange", () => { if (document.hidden && Module.calledRun) tendrilKeepFiles(); });

var Module = {
    canvas: document.getElementById("canvas"),
    arguments: [],
    preRun: [() => {
        FS.mkdirTree(kept);
        FS.mount(IDBFS, {}, kept);
        addRunDependency("files");
        FS.syncfs(true, async (error) => {
            if (error) console.warn(`no settings are kept here: ${error}`);
            try {
                const scene = await sceneOfAddress();
                if (scene) {
                    FS.mkdirTree("/files");
                    FS.writeFile("/files/link.json", scene);
                    Module.arguments.push("/files/link.json");
                }
            } catch (broken) {
                console.warn(`the address holds no scene: ${broken}`);
            }
            removeRunDependency("files");
        });
    }],
    setStatus: (text) => { if (text) state.textContent = text; },
    onAbort: (why) => tendrilFailed(`Tendril stopped: ${why}. Reload the page; unsaved work is offered then.`),
};
