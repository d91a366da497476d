// SPDX-License-Identifier: Apache-2.0
import { requireOpen } from './connection';
import { openCopy } from './copies';
import { element } from './dom';
import { Drive } from './drive';
import { Keys } from './keys';
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
import { sessionKeys } from './session_keys';
import { stageFor } from './stage';
import { statusText } from './status';
import { tabs } from './tabs';
import { themeSwitch } from './theme';
import { timeBar } from './time_bar';
import { Hands } from './touch';

/** Parts of a session's page besides scene, layers, plots and time line. */
export interface Offers {
  /** The console of a rig in real time. */
  rig: boolean;
  /** Parameters, dragging, steering and restart. */
  changes: boolean;
  /** Text on the page, for a separate tab. */
  about?: HTMLElement;
}

/** Page of a session at the server; for a rig in real time also the console. */
export async function sessionPage(session: number, isRig = false): Promise<Page> {
  await requireOpen(session);
  return pageOf(new Live(session, 'The run'), { rig: isRig, changes: true });
}

/** Page of a session: scene, panels and time line. */
export async function pageOf(live: Live, { rig: isRig, changes, about }: Offers): Promise<Page> {
  const { root: trouble, say } = notice();
  const stage = await stageFor(live);
  const { scene } = stage;
  scene.keepFree(60); // for the tools above it
  const parameters = changes ? new Parameters(live) : undefined;
  const time = timeBar([live], isRig || !parameters ? undefined : () => parameters.restart());
  const plots = new Plots([live], time.transport.seekTime);
  const layers = layersTab([scene], live);
  const drive = changes ? new Drive(live) : undefined;
  const hands = parameters ? new Hands(live, scene, parameters, say) : undefined;
  const tools = sceneTools(live, scene, drive, isRig);
  const rig = isRig && drive ? rigConsole(live, drive, say) : undefined;
  const key = legend(live, scene);
  const present = presentation(() => root, scene);
  const compare =
    parameters && live.isServed
      ? () => void openCopy(live, parameters).catch((error: Error) => say(error.message))
      : undefined;

  let isBroken = false; // before it opens, keys wait for its answer
  const keys = new Keys(
    sessionKeys({ time, drive, hands, stage, legend: key, present, more: tools.keys, isRig }),
    !isRig,
    () => isRig || !isBroken,
  );
  const up = (event: KeyboardEvent) => drive?.key(event, false);
  const blur = () => drive?.release();
  window.addEventListener('keyup', up);
  window.addEventListener('blur', blur);

  const over = element('div', { class: 'over' }, ...(hands ? [hands.tools] : []), tools.root);
  const title = element('h1', { class: 'title' });
  const status = element('output', { class: 'status' });
  const root = element(
    'div',
    { class: isRig ? 'session rig' : 'session' },
    ...(rig ? [rig.bar] : []),
    element(
      'nav',
      { class: 'top' },
      ...(live.isServed ? [element('a', { href: '#/', class: 'button quiet' }, '‹ Gallery')] : []),
      title,
      status,
      trouble,
      ...(isRig ? [] : [present.button]),
      toolButton('Keys', 'Show the keys (?)', () => keys.help()),
      themeSwitch(),
    ),
    element('div', { class: 'stage' }, scene.root, over, present.exit, key.root, ...(drive ? [drive.stick.root] : [])),
    time.root, // before the tabs, so that Play is soon reached by the Tab key
    tabs(isRig ? 'rig' : changes ? 'session' : 'player', [
      ...(about ? [{ name: 'About', panel: about }] : []),
      ...(isRig ? [{ name: 'Rig', panel: rigTab(live) }] : []),
      ...(parameters ? [{ name: 'Parameters', panel: parameters.root }] : []),
      { name: 'Layers', panel: layers.root, shown: layers.show },
      { name: 'Plots', panel: plots.root, shown: () => plots.show() },
      { name: 'Record', panel: recordTab(live, scene, time.transport.seekTime, compare) },
    ]),
  );
  live.listen((message) => {
    if (message.type === 'hello') {
      const name = String(message.scenario['name'] || message.name);
      title.textContent = name;
      document.title = `${name} – microswarm${live.isServed ? ' lab' : ''}`;
      root.classList.toggle('playback', message.playback);
      if (live.isServed && message.live !== isRig)
        location.hash = `#/${message.live ? 'rig' : 'session'}/${live.session}`;
      if (hands) hands.tools.hidden = message.playback || isRig;
    }
    if (message.type !== 'standing') return;
    root.dataset['status'] = message.status;
    root.dataset['mode'] = message.mode;
    root.dataset['growing'] = String(message.growing);
    const text = statusText(message, live.hello?.playback ?? false);
    if (status.value !== text) status.value = text;
  });
  let streamText = '';
  live.onLate((text) => say(text || streamText));
  live.onState((state, text) => {
    say((streamText = text));
    root.dataset['stream'] = state;
    isBroken = state !== 'open';
    over.inert = state !== 'open';
    if (parameters) parameters.root.inert = over.inert;
  });
  live.open();
  if (!isRig && location.hash.endsWith('/present')) present.set(true);
  return {
    root,
    say,
    keepsFiles: () => (rig?.isHot() ? 'The coils are driven: stop the rig before another file is opened.' : ''),
    isAtRisk: () => isAtRisk(live),
    mayLeave: () => mayLeave([live]),
    leave: () => {
      window.removeEventListener('keyup', up);
      window.removeEventListener('blur', blur);
      rig?.destroy();
      drive?.destroy();
      keys.destroy();
      key.destroy();
      plots.destroy();
      time.destroy();
      live.close();
      stage.destroy();
    },
  };
}
