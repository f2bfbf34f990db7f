// The connection to the server. It comes back by itself after a break.

import type { Reply, Request } from "./messages";

const AGAIN_MS = 1000;

export class Socket {
  private socket: WebSocket | null = null;

  constructor(
    private readonly hear: (reply: Reply) => void,
    private readonly state: (connected: boolean) => void,
  ) {
    this.connect();
  }

  ask(request: Request): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(request));
  }

  private connect(): void {
    const token = new URLSearchParams(location.search).get("token") ?? "";
    const socket = new WebSocket(`ws://${location.host}/socket?token=${token}`);
    socket.onopen = () => this.state(true);
    socket.onmessage = (event) => this.hear(JSON.parse(String(event.data)) as Reply);
    socket.onclose = () => {
      this.state(false);
      setTimeout(() => this.connect(), AGAIN_MS);
    };
    this.socket = socket;
  }
}
