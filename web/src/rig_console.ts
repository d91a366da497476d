// SPDX-License-Identifier: Apache-2.0
import { armPanel } from './arm_panel';
import { element } from './dom';
import type { Drive } from './drive';
import type { Live } from './live';
import { type Controls, type RigStanding, said } from './protocol';
import { rigLink } from './rig_link';
import { type ConsoleView, actOf, consoleOf, isSilent } from './rig_view';
import { StopRequest } from './stop_request';

export interface RigConsole {
  /** The bar, which is always visible. */
  bar: HTMLElement;
  /** Whether the coils are or may soon be driven. */
  isHot(): boolean;
  destroy(): void;
}

/** Arms and stops a rig. While it is armed, Space and Esc stop it regardless of the focus. */
export function rigConsole(live: Live, drive: Drive, say: (text: string, isTrouble?: boolean) => void): RigConsole {
  let rig: RigStanding | undefined;
  let controls: Controls | undefined;
  let arms = false; // requested, not yet answered
  let isLost = false;
  const isHot = () => view().isHot;
  const ask = async (request: Parameters<Live['ask']>[0]) => {
    const answer = await live.ask(request);
    say(said(answer));
  };
  const request = new StopRequest(() => show());
  const stop = () =>
    request.send(
      () => live.ask({ do: 'stop' }),
      () => isLost,
    );

  const badge = element('strong', { class: 'badge-rig', role: 'status' });
  const stopButton = element(
    'button',
    { type: 'button', class: 'stop', title: 'Coils to zero at once (space or Esc)', onclick: () => void stop() },
    'STOP',
  );
  const words = element('span', { class: 'why', tabindex: '0' });
  const link = rigLink(live);
  const armButton = button('Arm …', 'Drive the coils', () => panel.open(live.hello?.rig_info));
  const dryButton = button('Dry run', 'Restart without driving the coils', () => void ask({ do: 'dry' }));
  const takeButton = button('Take the controls', 'No page has the controls', () => void ask({ do: 'control' }));
  const holdButton = button(
    'Hold',
    'Hold the swarm',
    () => void ask({ do: 'hold', on: live.standing?.mode !== 'hold' }),
  );
  const manualButton = button('Steer', 'Steer with the arrow keys or a gamepad (m)', () => drive.toggle());
  const endButton = button('End', 'End the run and keep its record', () => void ask({ do: 'end' }));

  const panel = armPanel(() => {
    arms = true;
    show();
    void ask({ do: 'arm' }).finally(() => {
      arms = false;
      show();
    });
  });
  const buttons = {
    stop: stopButton,
    arm: armButton,
    dry: dryButton,
    hold: holdButton,
    manual: manualButton,
    end: endButton,
    take: takeButton,
  };

  const bar = element(
    'section',
    { class: 'rigbar', 'aria-label': 'Rig' },
    stopButton,
    badge,
    words,
    link.root,
    element('span', { class: 'acts' }, armButton, dryButton, holdButton, manualButton, endButton, takeButton),
    panel.root,
  );

  const view = () =>
    consoleOf({
      rig,
      controls,
      mode: live.standing?.mode,
      arms,
      isLost,
      silence: arms ? 0 : live.silence,
      isStopUnanswered: request.isUnanswered,
    });
  const show = () => {
    const now = view();
    bar.dataset['state'] = now.state;
    if (badge.textContent !== now.badge) badge.textContent = now.badge; // else it is read aloud each time
    words.textContent = now.words;
    for (const [name, button] of Object.entries(buttons)) {
      const { hidden, disabled, pressed } = now.buttons[name as keyof ConsoleView['buttons']];
      button.hidden = hidden;
      button.disabled = disabled;
      if (pressed !== undefined) button.setAttribute('aria-pressed', String(pressed));
    }
  };
  live.listen((message) => {
    if (message.type === 'rig') {
      rig = message;
      if (rig.state === 'ended') request.hasStopped();
    } else if (message.type === 'controls') controls = message;
    else if (message.type !== 'standing' && message.type !== 'hello') return;
    show();
  });
  live.onState((state) => {
    isLost = state !== 'open';
    if (isLost) panel.close();
    show();
  });

  const beat = new Worker('/beat.js', { type: 'module' });
  beat.onmessage = () => {
    if (isSilent(live.silence) || bar.dataset['state'] === 'silent') show();
    if (controls?.holds && !isLost) live.tell({ do: 'beat' });
  };
  const key = (event: KeyboardEvent) => {
    const act = actOf(event.key, isHot(), !panel.root.hidden);
    if (!act) return;
    event.stopImmediatePropagation();
    if (act === 'close') return panel.close();
    event.preventDefault();
    void stop();
  };
  window.addEventListener('keydown', key, { capture: true });
  show();
  return {
    bar,
    isHot,
    destroy: () => {
      window.removeEventListener('keydown', key, { capture: true });
      link.destroy();
      beat.terminate();
    },
  };
}

function button(label: string, title: string, act: () => void): HTMLButtonElement {
  return element('button', { type: 'button', title, onclick: act }, label);
}
