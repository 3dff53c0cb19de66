// SPDX-License-Identifier: GPL-3.0-or-later
// The line to the run: a websocket that is opened again when it breaks. Texts come as they are, frames one
// after the other, each after the one before was drawn.
export class Link {
  constructor(handlers) {
    this.handlers = handlers;
    this.chain = Promise.resolve();
    this.wait = 300;
    this.asked = new Map(); // marks of orders that wait for an answer
    this.mark = `${Math.floor(Math.random() * 1e9)}`;
    this.count = 0;
    this.open();
  }

  open() {
    const { protocol, host, pathname } = window.location;
    this.socket = new WebSocket(`${protocol === "https:" ? "wss" : "ws"}://${host}${pathname}s`);
    this.socket.binaryType = "arraybuffer";
    this.socket.addEventListener("open", () => {
      this.wait = 300;
      this.handlers.connected(true);
    });
    this.socket.addEventListener("message", (e) => { this.chain = this.chain.then(() => this.take(e.data)).catch(console.error); });
    this.socket.addEventListener("close", () => {
      this.handlers.connected(false);
      for (const ask of [...this.asked.keys()]) this.answered([{ ask, ok: false, text: "not connected" }]);
      setTimeout(() => this.open(), this.wait);
      this.wait = Math.min(4000, 2 * this.wait);
    });
  }

  async take(data) {
    if (typeof data === "string") {
      const message = JSON.parse(data);
      await this.handlers[message.kind]?.(message);
      return;
    }
    const head = new DataView(data, 0, 8);
    await this.handlers.frame(new Uint8Array(data, 8), head.getUint32(0, true), head.getUint32(4, true));
    this.send("a");
  }

  send(what) {
    if (this.socket.readyState !== WebSocket.OPEN) return false;
    this.socket.send(typeof what === "string" ? what : JSON.stringify(what));
    return true;
  }

  /** An order with an answer: a promise of words that are to be said, or none; it fails with what is wrong. */
  ask(name, more = {}) {
    const ask = `${this.mark} ${this.count += 1}`;
    return new Promise((resolve, reject) => {
      this.asked.set(ask, { resolve, reject });
      if (!this.order(name, { ...more, ask })) this.answered([{ ask, ok: false, text: "not connected" }]);
    });
  }

  answered(list) {
    for (const { ask, ok, text } of list) {
      const one = this.asked.get(ask);
      this.asked.delete(ask);
      if (one && ok) one.resolve(text); else if (one) one.reject(new Error(text));
    }
  }

  order(name, more = {}) { return this.send({ do: name, ...more }); }
}
