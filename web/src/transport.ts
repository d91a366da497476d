// SPDX-License-Identifier: Apache-2.0
import { isContact, nextEvent } from './events';
import type { Live } from './live';
import { fasterSpeed } from './speeds';

/** Control of the time of one session, or of several in step. */
export class Transport {
  /** `again` restarts the sessions. */
  constructor(
    private readonly sessions: Live[],
    private readonly again?: () => Promise<unknown>,
  ) {}

  get anyPlays(): boolean {
    return this.sessions.some((one) => one.standing?.plays);
  }

  get allEnded(): boolean {
    return this.sessions.every((one) => one.standing?.ended);
  }

  /** Whether the next play restarts the runs. */
  get isOver(): boolean {
    return this.again !== undefined && !this.first.hello?.playback && !this.anyPlays && this.allEnded;
  }

  get first(): Live {
    return this.sessions[0] as Live;
  }

  /** The session with the most frames; the others show the same time. */
  get lead(): Live {
    return this.sessions.reduce((a, b) => (b.history.times.length > a.history.times.length ? b : a), this.first);
  }

  readonly play = () => void (this.isOver ? this.playAgain() : this.anyPlays ? this.pause() : this.all({ do: 'play' }));
  readonly step = () => this.all({ do: 'step' });
  readonly live = () => this.all({ do: 'live' });
  readonly setSpeed = (speed: number) => this.all({ do: 'speed', number: speed });
  readonly speed = (by: number) => this.setSpeed(fasterSpeed(this.first.standing?.speed ?? 1, by));
  readonly seek = (frame: number) => {
    const { times } = this.lead.history;
    const time = times[Math.max(0, Math.min(times.length - 1, frame))];
    if (time !== undefined) this.seekTime(time);
  };
  readonly seekTime = (time: number) => {
    for (const one of this.sessions) one.seek(one.history.nearest(time));
  };
  readonly seekBy = (frames: number) => {
    if (!this.anyPlays) this.seek((this.lead.standing?.frame ?? 0) + frames);
  };
  /** Seeks the next event, or the one before if `by` is negative. */
  readonly seekEvent = (by: number) => {
    const event = nextEvent(this.lead.history.events, this.lead.shown, by);
    if (event && !this.anyPlays) this.seekTime(event.t_s);
  };

  /** Seeks the next contact, or the one before if `by` is negative. */
  readonly seekContact = (by: number) => {
    const event = nextEvent(this.lead.history.events.filter(isContact), this.lead.shown, by);
    if (event && !this.anyPlays) this.seekTime(event.t_s);
  };

  private all(request: Parameters<Live['ask']>[0]): void {
    for (const one of this.sessions) void one.ask(request);
  }

  private async playAgain(): Promise<void> {
    await this.again?.();
    if (!this.sessions.some((one) => one.standing?.ended)) this.all({ do: 'play' });
  }

  /** Advances the sessions that are behind to the time of the first. */
  private async pause(): Promise<void> {
    await Promise.all(this.sessions.map((one) => one.ask({ do: 'pause' })));
    if (this.sessions.length < 2) return;
    const newest = this.sessions.map((one) => one.history.times.at(-1) ?? 0);
    const until = Math.max(...newest);
    this.sessions.forEach((one, i) => {
      if ((newest[i] as number) < until && !one.standing?.ended) void one.ask({ do: 'play', number: until });
    });
  }
}
