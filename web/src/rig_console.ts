// SPDX-License-Identifier: Apache-2.0
import { element } from './dom';
import type { Drive } from './drive';
import type { Live } from './live';
import { type Controls, type RigInfo, type RigStanding, said } from './protocol';
import { number } from './numbers';
import { rigLink } from './rig_link';
import { type ConsoleView, actOf, consoleOf, isSilent } from './rig_view';

const answerTime = 500; // maximum time of the answer to a stop [ms]

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
  let stops = 0; // number of the last stop
  let isStopUnanswered = false;
  const stop = async () => {
    const own = ++stops;
    const late = window.setTimeout(() => {
      isStopUnanswered = true;
      show();
    }, answerTime);
    await live.ask({ do: 'stop' });
    window.clearTimeout(late);
    if (own !== stops || isLost) return; // a broken stream answers too
    isStopUnanswered = false;
    show();
  };

  const badge = element('strong', { class: 'badge-rig', role: 'status' });
  const stopButton = element(
    'button',
    { type: 'button', class: 'stop', title: 'Coils to zero at once (space or Esc)', onclick: () => void stop() },
    'STOP',
  );
  const words = element('span', { class: 'why', tabindex: '0' });
  const link = rigLink(live);
  const armButton = button('Arm …', 'Drive the coils', () => openPanel());
  const dryButton = button('Dry run', 'Restart without driving the coils', () => void ask({ do: 'dry' }));
  const takeButton = button('Take the controls', 'No page has the controls', () => void ask({ do: 'control' }));
  const holdButton = button(
    'Hold',
    'Hold the swarm',
    () => void ask({ do: 'hold', on: live.standing?.mode !== 'hold' }),
  );
  const manualButton = button('Steer', 'Steer with the arrow keys or a gamepad (m)', () => drive.toggle());
  const endButton = button('End', 'End the run and keep its record', () => void ask({ do: 'end' }));

  const facts = element('ul', {});
  const cancel = button('Cancel', '', () => closePanel());
  const confirm = button('Arm: drive the coils', '', () => {
    closePanel();
    arms = true;
    show();
    void ask({ do: 'arm' }).finally(() => {
      arms = false;
      show();
    });
  });
  confirm.classList.add('danger');
  const panel = element(
    'div',
    { class: 'arm-panel', role: 'alertdialog', 'aria-label': 'Arm the rig', hidden: true },
    element('strong', {}, 'Drive the coils?'),
    facts,
    element('div', { class: 'row' }, cancel, confirm),
  );
  const openPanel = () => {
    facts.replaceChildren(...factsOf(live.hello?.rig_info).map((one) => element('li', {}, one)));
    panel.hidden = false;
    cancel.focus();
  };
  const closePanel = () => {
    panel.hidden = true;
  };
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
    panel,
  );

  const view = () =>
    consoleOf({
      rig,
      controls,
      mode: live.standing?.mode,
      arms,
      isLost,
      silence: arms ? 0 : live.silence,
      isStopUnanswered,
    });
  const show = () => {
    const now = view();
    bar.dataset['state'] = now.state;
    badge.textContent = now.badge;
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
      if (rig.state === 'ended') isStopUnanswered = false;
    } else if (message.type === 'controls') controls = message;
    else if (message.type !== 'standing' && message.type !== 'hello') return;
    show();
  });
  live.onState((state) => {
    isLost = state !== 'open';
    if (isLost) closePanel();
    show();
  });

  const beat = new Worker('/beat.js', { type: 'module' });
  beat.onmessage = () => {
    if (isSilent(live.silence) || bar.dataset['state'] === 'silent') show();
    if (controls?.holds && !isLost) live.tell({ do: 'beat' });
  };
  const key = (event: KeyboardEvent) => {
    const act = actOf(event.key, isHot(), !panel.hidden);
    if (!act) return;
    event.stopImmediatePropagation();
    if (act === 'close') return closePanel();
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

/** Facts shown before the coils are driven. */
function factsOf(info: RigInfo | undefined): string[] {
  if (!info) return [];
  const limit = (values: (number | null)[], unit: string) => {
    const known = values.filter((one): one is number => one !== null);
    return known.length > 0 ? `at most ${number(Math.max(...known))} ${unit}` : `no limit in ${unit}`;
  };
  return [
    `${info.name}: ${info.coils.length} ${info.real_coils ? 'coils are driven by a device' : 'simulated coils'}, ${info.real_camera ? 'a real camera' : 'a simulated camera'}`,
    `Field of ${number(info.field_mt)} mT; ${limit(info.max_current_a, 'A')}, ${limit(info.max_temperature_c, '°C')}`,
    'Space, Esc, the button and closing this page stop it.',
    ...info.warnings,
  ];
}
