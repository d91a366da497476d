// SPDX-License-Identifier: Apache-2.0
import { openCopy } from './compare_page';
import { whyClosed } from './connection';
import { element } from './dom';
import { Drive } from './drive';
import { Keys } from './keys';
import { layersTab } from './layers_tab';
import { Live } from './live';
import type { Page } from './page';
import { Parameters } from './parameters';
import { Plots } from './plots';
import { recordTab } from './record_tab';
import { rigConsole } from './rig_console';
import { rigTab } from './rig_tab';
import { stageFor } from './stage';
import { tabs } from './tabs';
import { themeSwitch } from './theme';
import { timeBar, timeKeys } from './time_bar';
import { Hands } from './touch';

const noteShown = 6000; // [ms]
const stopKeys = [
  { keys: [], shown: 'space, Esc', does: 'stop: coils to zero at once, while it is armed', act: () => undefined },
];

/** Page of one session: scene, panels and time line; for a rig in real time also the console. */
export async function sessionPage(session: number, isRig = false): Promise<Page> {
  const trouble = element('p', { class: 'trouble', role: 'alert' });
  let fades: number | undefined;
  const say = (text: string, isTrouble = true) => {
    trouble.replaceChildren(text);
    trouble.title = text;
    trouble.classList.toggle('note', !isTrouble);
    window.clearTimeout(fades);
    if (!isTrouble) fades = window.setTimeout(() => say(''), noteShown);
  };
  const live = new Live(session, () => void whyClosed('The session').then((why) => say(why)));
  const stage = await stageFor(live);
  const { scene } = stage;
  scene.keepFree(60); // for the tools above it
  const parameters = new Parameters(live);
  const time = timeBar([live], isRig ? undefined : () => parameters.restart());
  const plots = new Plots([live], time.seekTime);
  const layers = layersTab([scene]);
  const drive = new Drive(live);
  const hands = new Hands(live, scene, parameters, say);
  const rig = isRig ? rigConsole(live, drive, say) : undefined;
  const compare = () =>
    openCopy(live, parameters).catch((error: Error) => say(error.message));

  let follows = false;
  const toggleFollow = () => scene.follow(!follows);
  const followButton = button('Follow', 'Follow the swarm (l)', toggleFollow);
  scene.onFollow((on) => {
    follows = on;
    followButton.setAttribute('aria-pressed', String(on));
  });
  const manualButton = button('Steer', 'Steer with the arrow keys or a gamepad (m)', () => drive.toggle());
  const arrow = (by: number) => (event: KeyboardEvent) => {
    if (!drive.key(event, true)) time.seekBy(by * (event.shiftKey ? 10 : 1));
  };
  const keys = new Keys([
    ...(isRig ? stopKeys : timeKeys(time)),
    { keys: ['ArrowLeft'], shown: '←', does: 'previous frame (Shift: ten) · steer left', act: arrow(-1) },
    { keys: ['ArrowRight'], shown: '→', does: 'next frame (Shift: ten) · steer right', act: arrow(1) },
    { keys: ['ArrowUp', 'ArrowDown'], shown: '↑ ↓', does: 'steer (Shift: slowly)', act: arrow(0) },
    { keys: ['f'], shown: 'f', does: 'fit the map', act: () => scene.fit() },
    { keys: ['l'], shown: 'l', does: 'follow the swarm', act: toggleFollow },
    { keys: ['m'], shown: 'm', does: 'steer by hand', act: () => drive.toggle() },
    ...(isRig ? [] : [{ keys: ['Escape'], shown: 'Esc', does: 'deselect the tool', act: () => hands.choose(undefined) }]),
  ], !isRig);
  const up = (event: KeyboardEvent) => drive.key(event, false);
  const blur = () => drive.release();
  window.addEventListener('keyup', up);
  window.addEventListener('blur', blur);

  const title = element('h1', { class: 'title' });
  const status = element('output', { class: 'status' });
  live.listen((message) => {
    if (message.type === 'hello') {
      const name = String(message.scenario['name'] || message.name);
      title.textContent = name;
      document.title = `${name} – microswarm lab`;
      root.classList.toggle('playback', message.playback);
      if (message.live !== isRig) location.hash = `#/${message.live ? 'rig' : 'session'}/${session}`;
      hands.tools.hidden = message.playback || isRig;
      manualButton.hidden = message.playback || isRig;
    }
    if (message.type !== 'standing') return;
    root.dataset['status'] = message.status;
    root.dataset['mode'] = message.mode;
    manualButton.setAttribute('aria-pressed', String(message.mode === 'manual'));
    root.dataset['growing'] = String(message.growing);
    status.value = message.growing
      ? 'still being written'
      : statusText(message.mode, (!message.ended && message.state) || message.status);
  });
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
      button('Keys', 'Show the keys (?)', () => keys.help()),
      themeSwitch(),
    ),
    element(
      'div',
      { class: 'stage' },
      scene.root,
      element(
        'div',
        { class: 'over' },
        hands.tools,
        element(
          'div',
          { class: 'tools' },
          button('−', 'Zoom out', () => scene.zoomBy(1 / 1.25)),
          button('+', 'Zoom in', () => scene.zoomBy(1.25)),
          button('Fit', 'Fit the map (f)', () => scene.fit()),
          followButton,
          manualButton,
        ),
      ),
    ),
    tabs(isRig ? 'rig' : 'session', [
      ...(isRig ? [{ name: 'Rig', panel: rigTab(live) }] : []),
      { name: 'Parameters', panel: parameters.root },
      { name: 'Layers', panel: layers.root, shown: layers.show },
      { name: 'Plots', panel: plots.root, shown: () => plots.show() },
      { name: 'Record', panel: recordTab(live, scene, () => void compare()) },
    ]),
    time.root,
  );
  live.open();
  return {
    root,
    leave: () => {
      window.removeEventListener('keyup', up);
      window.removeEventListener('blur', blur);
      rig?.destroy();
      drive.destroy();
      keys.destroy();
      plots.destroy();
      live.close();
      stage.destroy();
    },
  };
}

function button(label: string, title: string, act: () => void): HTMLButtonElement {
  return element('button', { type: 'button', title, onclick: act }, label);
}

function statusText(mode: string, state: string): string {
  return (mode === 'autonomous' || mode === state ? state : `${mode} · ${state}`).replaceAll('_', ' ');
}
