// SPDX-License-Identifier: Apache-2.0
import { type Answer, type Message, type Request, read } from './protocol';

const gone = 'The lab has ended or cannot be reached. Start it again and open the address that it prints.';

/** Reason for the end of a stream that this page did not close. */
export async function whyClosed(what: string): Promise<string> {
  try {
    await call('GET', '/api/schema');
    return `${what} is closed. Open it again from the gallery.`;
  } catch (error) {
    return (error as Error).message;
  }
}

/** Sends a request to the server; an error has the server's text. */
export async function call<T>(method: 'GET' | 'POST', path: string, body?: unknown): Promise<T> {
  const response = await fetch(path, {
    method,
    ...(body === undefined ? {} : { body: JSON.stringify(body) }),
  }).catch(() => {
    throw new Error(gone);
  });
  const json = await response.json();
  if (!response.ok) throw new Error(json.error ?? response.statusText);
  return json as T;
}

const closed: Answer = { type: 'answer', id: 0, issues: [{ keys: [], text: 'the session is closed' }] };

type Listener = (message: Message) => void;

/** The message stream of a session. */
export class Connection {
  private readonly socket: WebSocket;
  private readonly waiting = new Map<number, (answer: Answer) => void>();
  private readonly listeners: Listener[] = [];
  private next = 1;

  constructor(session: number, onClose: () => void) {
    const scheme = location.protocol === 'https:' ? 'wss' : 'ws';
    this.socket = new WebSocket(`${scheme}://${location.host}/api/stream/${session}`);
    this.socket.binaryType = 'arraybuffer';
    this.socket.onmessage = (event) => this.take(read(event.data as ArrayBuffer));
    this.socket.onclose = () => {
      this.settle(closed);
      onClose();
    };
  }

  listen(listener: Listener): void {
    this.listeners.push(listener);
  }

  /** Sends a request, once the stream is open; the answer lists its issues, if any. */
  ask(request: Request): Promise<Answer> {
    const id = this.next++;
    if (this.socket.readyState > WebSocket.OPEN) return Promise.resolve({ ...closed, id });
    const send = () => this.socket.send(JSON.stringify({ id, ...request }));
    if (this.socket.readyState === WebSocket.OPEN) send();
    else this.socket.addEventListener('open', send, { once: true });
    return new Promise((resolve) => this.waiting.set(id, resolve));
  }

  /** Sends a request that has no answer; does nothing unless the stream is open. */
  tell(request: Request): void {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(request));
  }

  close(): void {
    this.socket.onclose = null;
    this.socket.close();
    this.settle(closed);
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
