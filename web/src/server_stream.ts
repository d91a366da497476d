// SPDX-License-Identifier: Apache-2.0
import { type Connection, statusOf } from './connection';
import { type Answer, type Message, type Request, read } from './protocol';
import { type StreamState, attemptsAfter, pauseBefore, verdictOf } from './reconnect';

const closed: Answer = {
  type: 'answer',
  id: 0,
  issues: [{ keys: [], text: 'The connection is broken: nothing was changed.' }],
};

/** The message stream of a session at the server. A stream that breaks is opened again until the session is gone. */
export class ServerStream implements Connection {
  private socket: WebSocket;
  private readonly waiting = new Map<number, (answer: Answer) => void>();
  private readonly listeners: ((message: Message) => void)[] = [];
  private next = 1;
  private attempts = 0;
  private opened: number | undefined; // time at which the stream opened [ms]
  private timer: number | undefined;
  private isLeft = false;

  /** `what` names the session in the texts of `onState`. */
  constructor(
    private readonly session: number,
    private readonly what: string,
    private readonly onState: (state: StreamState, text: string) => void,
  ) {
    this.socket = this.open();
  }

  listen(listener: (message: Message) => void): void {
    this.listeners.push(listener);
  }

  /** Sends a request, once the stream is open for the first time. */
  ask(request: Request): Promise<Answer> {
    const id = this.next++;
    const { socket } = this;
    const isBroken = socket.readyState > WebSocket.OPEN || (this.attempts > 0 && socket.readyState !== WebSocket.OPEN);
    if (isBroken) return Promise.resolve({ ...closed, id });
    const send = () => socket.send(JSON.stringify({ id, ...request }));
    if (socket.readyState === WebSocket.OPEN) send();
    else socket.addEventListener('open', send, { once: true });
    return new Promise((resolve) => this.waiting.set(id, resolve));
  }

  /** Does nothing unless the stream is open. */
  tell(request: Request): void {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(request));
  }

  close(): void {
    this.isLeft = true;
    window.clearTimeout(this.timer);
    this.socket.close();
    this.settle(closed);
  }

  private open(): WebSocket {
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    const socket = new WebSocket(`${scheme}://${location.host}/api/stream/${this.session}`);
    socket.binaryType = 'arraybuffer';
    socket.onmessage = (event) => this.take(read(event.data as ArrayBuffer));
    socket.onopen = () => {
      this.opened = performance.now();
      this.onState('open', '');
    };
    socket.onclose = () => void this.broke();
    return socket;
  }

  private async broke(): Promise<void> {
    if (this.isLeft) return;
    const life = this.opened === undefined ? 0 : performance.now() - this.opened;
    this.opened = undefined;
    this.attempts = attemptsAfter(this.attempts, life);
    this.settle(closed);
    const verdict = verdictOf(await statusOf(this.session), this.what);
    if (this.isLeft) return;
    this.onState(verdict.state, verdict.text);
    if (verdict.state === 'closed') return;
    this.timer = window.setTimeout(() => (this.socket = this.open()), pauseBefore(this.attempts++));
  }

  /** Settles a request. Id 0 answers an unreadable message, so it settles all. */
  private settle(answer: Answer): void {
    const settled = answer.id === 0 ? [...this.waiting.keys()] : [answer.id];
    for (const id of settled) {
      this.waiting.get(id)?.(answer);
      this.waiting.delete(id);
    }
  }

  private take(message: Message): void {
    if (message.type === 'answer') this.settle(message);
    for (const listener of this.listeners) listener(message);
  }
}
