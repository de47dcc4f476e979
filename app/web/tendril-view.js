// <tendril-view lab="rope"></tendril-view>: a scene that moves, in any page. One script embeds it:
//   <script src="https://.../tendril-view.js"></script>
// `lab` is the name of a lab, which opens as in a new window; or `scene`, the part after "#scene=" of a link.
"use strict";

const tendrilFolder = new URL(".", document.currentScript.src);

customElements.define("tendril-view", class extends HTMLElement {
    connectedCallback() {
        const frame = document.createElement("iframe");
        const what = ["scene", "lab"].find((each) => this.hasAttribute(each));
        frame.src = new URL("index.html", tendrilFolder) + (what ? `#${what}=${this.getAttribute(what)}` : "");
        frame.title = this.getAttribute("title") ?? "Tendril";
        frame.style.cssText = "border: 0; width: 100%; height: 100%; min-height: 20em";
        frame.loading = "lazy";
        this.style.display ||= "block";
        this.append(frame);
    }
});
