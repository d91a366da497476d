// SPDX-License-Identifier: Apache-2.0
import type { Page } from './app';
import { Connection } from './connection';
import { element } from './dom';
import type { Message } from './protocol';
import { Scene } from './scene/scene';

/** The page of one session: its scene and its controls. */
export async function sessionPage(session: number): Promise<Page> {
  const trouble = element('p', { class: 'trouble', role: 'alert' });
  const connection = new Connection(session, () =>
    trouble.replaceChildren('The session is closed. Open it again from the gallery.'),
  );
  const scene = await Scene.create();
  scene.onWant((request) => void connection.ask(request));
  Object.assign(window, { microswarm: { scene, connection } }); // for tests
  const clock = element('output', { class: 'clock' });
  const play = element('button', { class: 'play', onclick: () => toggle() }, 'Play');
  let plays = false;
  const toggle = () => void connection.ask({ do: plays ? 'pause' : 'play' });
  connection.listen((message: Message) => {
    scene.take(message);
    if (message.type === 'standing') {
      plays = message.plays;
      play.textContent = plays ? 'Pause' : 'Play';
      root.dataset['status'] = message.status;
    }
    if (message.type === 'frame') clock.textContent = `${Number(message.frame['t_s']).toFixed(1)} s`;
  });
  const root = element(
    'div',
    { class: 'session' },
    element('nav', {}, element('a', { href: '#/' }, 'Gallery'), play, clock, trouble),
    scene.root,
  );
  return {
    root,
    leave: () => {
      connection.close();
      scene.destroy();
    },
  };
}
