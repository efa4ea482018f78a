/**
 * The one WebSocket to the base: connects, hands over texts and frames, comes back by itself after
 * a loss (within a second), and says how it stands. It never queues what cannot be sent: a command
 * that waits for a connection would be carried out at a moment that nobody chose.
 */
// SPDX-License-Identifier: Apache-2.0

export interface Listener {
  opened(): void;
  closed(): void;
  text(message: { type: string } & Record<string, unknown>): void;
  binary(view: DataView): void;
  /** A text that is no JSON object with a type: counted, otherwise ignored. */
  unreadable(): void;
}

const kFirstRetryMs = 200;
const kLastRetryMs = 800;

export class BaseSocket {
  private socket: WebSocket | null = null;
  private retryMs = kFirstRetryMs;

  constructor(
    private readonly url: string,
    private readonly listener: Listener,
  ) {}

  connect(): void {
    const socket = new WebSocket(this.url);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    socket.onopen = () => {
      this.retryMs = kFirstRetryMs;
      this.listener.opened();
    };
    socket.onmessage = (event) => this.receive(event.data);
    socket.onclose = () => {
      if (this.socket !== socket) return;
      this.socket = null;
      this.listener.closed();
      setTimeout(() => this.connect(), this.retryMs);
      this.retryMs = Math.min(this.retryMs * 2, kLastRetryMs);
    };
  }

  /** False where the message could not be handed to an open connection. */
  send(message: Record<string, unknown>): boolean {
    if (this.socket?.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(message));
    return true;
  }

  private receive(data: string | ArrayBuffer): void {
    if (typeof data !== "string") {
      this.listener.binary(new DataView(data));
      return;
    }
    let message: unknown;
    try {
      message = JSON.parse(data);
    } catch {
      this.listener.unreadable();
      return;
    }
    if (typeof message === "object" && message !== null && "type" in message) {
      this.listener.text(message as { type: string } & Record<string, unknown>);
    } else {
      this.listener.unreadable();
    }
  }
}
