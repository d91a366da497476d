// SPDX-License-Identifier: Apache-2.0
import { requireOpen } from './connection';
import { openCopy } from './copies';
import { element } from './dom';
import { Drive } from './drive';
import { type Key, Keys } from './keys';
import { layersTab } from './layers_tab';
import { legend } from './legend';
import { Live } from './live';
import { isAtRisk, mayLeave } from './loss';
import { notice } from './notice';
import type { Page } from './page';
import { Parameters } from './parameters';
import { Plots } from './plots';
import { presentation } from './present';
import { recordTab } from './record_tab';
import { rigConsole } from './rig_console';
import { rigTab } from './rig_tab';
import { sceneTools, toolButton } from './scene_tools';
import { stageFor } from './stage';
import { statusText } from './status';
import { tabs } from './tabs';
import { themeSwitch } from './theme';
import { timeBar, timeKeys } from './time_bar';
import { Hands } from './touch';

const stopKeys: Key[] = [
  { keys: [], shown: 'space, Esc', does: 'stop: coils to zero at once, while it is armed', act: () => undefined },
];

/** Page of one session: scene, panels and time line; for a rig in real time also the console. */
export async function sessionPage(session: number, isRig = false): Promise<Page> {
  await requireOpen(session);
  const { root: trouble, say } = notice();
  const live = new Live(session, 'The run');
  const stage = await stageFor(live);
  const { scene } = stage;
  scene.keepFree(60); // for the tools above it
  const parameters = new Parameters(live);
  const time = timeBar([live], isRig ? undefined : () => parameters.restart());
  const plots = new Plots([live], time.transport.seekTime);
  const layers = layersTab([scene]);
  const drive = new Drive(live);
  const hands = new Hands(live, scene, parameters, say);
  const tools = sceneTools(live, scene, drive, isRig);
  const rig = isRig ? rigConsole(live, drive, say) : undefined;
  const key = legend(live, scene);
  const present = presentation(() => root, scene);
  const compare = () => openCopy(live, parameters).catch((error: Error) => say(error.message));

  let isBroken = false; // before it opens, keys wait for its answer
  const arrow = (by: number) => (event: KeyboardEvent) => {
    if (!drive.key(event, true)) time.transport.seekBy(by * (event.shiftKey ? 10 : 1));
  };
  const keys = new Keys(
    [
      ...(isRig ? stopKeys : timeKeys(time)),
      { keys: ['ArrowLeft'], shown: '←', does: 'previous frame (Shift: ten) · steer left', act: arrow(-1) },
      { keys: ['ArrowRight'], shown: '→', does: 'next frame (Shift: ten) · steer right', act: arrow(1) },
      { keys: ['ArrowUp', 'ArrowDown'], shown: '↑ ↓', does: 'steer (Shift: slowly)', act: arrow(0) },
      ...tools.keys,
      { keys: ['i'], shown: 'i', does: 'say what is at the middle of the view', act: stage.sayMiddle },
      { keys: ['k'], shown: 'k', does: 'fold the legend', act: key.toggle },
      ...(isRig
        ? []
        : [
            ...present.keys,
            {
              keys: ['Escape'],
              shown: 'Esc',
              does: 'deselect the tool, leave the presentation',
              act: () => (present.isOn ? present.set(false) : hands.choose(undefined)),
            },
            { keys: ['x'], shown: 'x', does: 'use the chosen tool at the middle of the view', act: () => hands.use() },
          ]),
    ],
    !isRig,
    () => isRig || !isBroken,
  );
  const up = (event: KeyboardEvent) => drive.key(event, false);
  const blur = () => drive.release();
  window.addEventListener('keyup', up);
  window.addEventListener('blur', blur);

  const over = element('div', { class: 'over' }, hands.tools, tools.root);
  const title = element('h1', { class: 'title' });
  const status = element('output', { class: 'status' });
  const root = element(
    'div',
    { class: isRig ? 'session rig' : 'session' },
    ...(rig ? [rig.bar] : []),
    element(
      'nav',
      { class: 'top' },
      element('a', { href: '#/', class: 'button quiet' }, '‹ Gallery'),
      title,
      status,
      trouble,
      ...(isRig ? [] : [present.button]),
      toolButton('Keys', 'Show the keys (?)', () => keys.help()),
      themeSwitch(),
    ),
    element('div', { class: 'stage' }, scene.root, over, present.exit, key.root),
    time.root, // before the tabs, so that Play is soon reached by the Tab key
    tabs(isRig ? 'rig' : 'session', [
      ...(isRig ? [{ name: 'Rig', panel: rigTab(live) }] : []),
      { name: 'Parameters', panel: parameters.root },
      { name: 'Layers', panel: layers.root, shown: layers.show },
      { name: 'Plots', panel: plots.root, shown: () => plots.show() },
      { name: 'Record', panel: recordTab(live, scene, () => void compare(), time.transport.seekTime) },
    ]),
  );
  live.listen((message) => {
    if (message.type === 'hello') {
      const name = String(message.scenario['name'] || message.name);
      title.textContent = name;
      document.title = `${name} – microswarm lab`;
      root.classList.toggle('playback', message.playback);
      if (message.live !== isRig) location.hash = `#/${message.live ? 'rig' : 'session'}/${session}`;
      hands.tools.hidden = message.playback || isRig;
    }
    if (message.type !== 'standing') return;
    root.dataset['status'] = message.status;
    root.dataset['mode'] = message.mode;
    root.dataset['growing'] = String(message.growing);
    const text = statusText(message, live.hello?.playback ?? false);
    if (status.value !== text) status.value = text;
  });
  live.onState((state, text) => {
    say(text);
    root.dataset['stream'] = state;
    isBroken = state !== 'open';
    over.inert = parameters.root.inert = state !== 'open';
  });
  live.open();
  if (!isRig && location.hash.endsWith('/present')) present.set(true);
  return {
    root,
    isAtRisk: () => isAtRisk(live),
    mayLeave: () => mayLeave([live]),
    leave: () => {
      window.removeEventListener('keyup', up);
      window.removeEventListener('blur', blur);
      rig?.destroy();
      drive.destroy();
      keys.destroy();
      key.destroy();
      plots.destroy();
      time.destroy();
      live.close();
      stage.destroy();
    },
  };
}
