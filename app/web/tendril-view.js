// <tendril-view scene="..."></tendril-view>: a scene that moves, in any page. One script embeds it:
//   <script src="https://.../tendril-view.js"></script>
// `scene` is the part after "#scene=" of a link; without it the program opens as it does by itself.
"use strict";

const tendrilFolder = new URL(".", document.currentScript.src);

customElements.define("tendril-view", class extends HTMLElement {
    connectedCallback() {
        const frame = document.createElement("iframe");
        const scene = this.getAttribute("scene");
        frame.src = new URL("index.html", tendrilFolder) + (scene ? `#scene=${scene}` : "");
        frame.title = this.getAttribute("title") ?? "Tendril";
        frame.style.cssText = "border: 0; width: 100%; height: 100%; min-height: 20em";
        frame.loading = "lazy";
        this.style.display ||= "block";
        this.append(frame);
    }
});
