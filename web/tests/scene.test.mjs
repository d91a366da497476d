// SPDX-License-Identifier: Apache-2.0
// The scene in a browser, on scenarios of every kind. Its pictures are to be looked at.
import assert from 'node:assert/strict';
import { writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { drawRobots, openPage, root, startBrowser, startLab, until } from './lab.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());

/** Opens a scenario and plays it until `t` [s]. */
async function playTo(run, file, t, { speed = 0, size, options = [] } = {}) {
  const lab = await startLab(file, ...options);
  run.after(() => lab.process.kill('SIGKILL'));
  const lookedAt = await openPage(browser, lab.url, size);
  const { page } = lookedAt;
  const hasMap = () => window.microswarm && String(window.microswarm.scene.view.hi) !== '1,1';
  await until(page, hasMap, { seconds: 120 });
  await page.evaluate(
    ([speed, t]) => {
      const { connection, scene } = window.microswarm;
      const numbers = (bytes) => [...new Float32Array(bytes.slice().buffer)];
      window.touches = [];
      scene.onTouch((touch) => window.touches.push(touch));
      void connection.ask({ do: 'speed', number: speed });
      void connection.ask({ do: 'play' });
      connection.listen((message) => {
        if (message.type === 'clearance')
          window.clearance = { ...message, values: numbers(message.values) };
        if (message.type === 'frame')
          window.discs = numbers(message.bodies.discs);
        if (message.type === 'frame' && message.predicted)
          window.predicted = numbers(message.predicted.bodies);
        if (message.type !== 'frame' || message.frame.t_s < t || window.reached) return;
        window.reached = true;
        void connection.ask({ do: 'pause' });
      });
    },
    [speed, t],
  );
  await until(page, () => window.reached, { seconds: 120 });
  const handle = await page.evaluateHandle(() => window.microswarm.scene);
  await page.waitForTimeout(300);
  return {
    ...lookedAt,
    lab,
    scene: (work, argument) => handle.evaluate(work, argument),
  };
}

test('obstacles as the predictive navigator expects them', async (t) => {
  const options = ['--set', 'navigator.type=predictive'];
  const run = await playTo(t, 'scenarios/papers/radar/twelve.yaml', 20, { speed: 20, options });
  await run.picture('scene-predictions');
  await run.scene((scene) => scene.follow(true));
  await run.scene((scene) => scene.zoomBy(4));
  await run.page.waitForTimeout(200);
  const shown = await run.picture('scene-predictions-close');
  const [predicted, discs] = await run.page.evaluate(() => [window.predicted, window.discs]);
  assert.ok(predicted.length >= 6 && predicted.length % 6 === 0);
  // The first steps are beside the discs of the frame.
  const first = predicted[1];
  for (let i = 0; i < predicted.length && predicted[i + 1] === first; i += 6) {
    const [x, y, radius] = predicted.slice(i + 2, i + 5);
    const gaps = [];
    for (let k = 0; k < discs.length; k += 4) gaps.push(Math.hypot(x - discs[k], y - discs[k + 1]));
    assert.ok(Math.min(...gaps) < radius, `${Math.min(...gaps)}`);
  }
  await run.scene((scene) => scene.show('predictions', false));
  await run.page.waitForTimeout(200);
  assert.ok(!shown.equals(await run.page.screenshot()));
  await run.close();
});

test('radar among twelve obstacles', async (t) => {
  const run = await playTo(t, 'scenarios/papers/radar/twelve.yaml', 38, { speed: 20 });
  await run.picture('scene-radar');
  await run.scene((scene) => scene.follow(true));
  await run.scene((scene) => scene.zoomBy(6));
  await run.page.waitForTimeout(200);
  await run.picture('scene-radar-close');
  await run.scene((scene) => scene.setTheme('dark'));
  await run.page.waitForTimeout(200);
  await run.picture('scene-radar-dark');
  await run.close();
});

test('robots gather; regions and clearance', async (t) => {
  const run = await playTo(t, 'scenarios/papers/gather/vascular_network.yaml', 5, { speed: 8 });
  await run.picture('scene-gather');
  await run.scene((scene) => scene.setTheme('dark'));
  await run.page.waitForTimeout(200);
  await run.picture('scene-gather-dark');
  await run.scene((scene) => scene.show('aggregation', false));
  await run.scene((scene) => scene.show('clearance', true));
  await until(run.page, () => window.clearance, { seconds: 20 });
  await run.page.waitForTimeout(600);
  await run.picture('scene-clearance');
  const { cell, columns, rows, values } = await run.page.evaluate(() => window.clearance);
  assert.ok(columns * rows <= 40_000 && values.length === columns * rows);
  const at = (x, y) => values[Math.floor(y / cell) * columns + Math.floor(x / cell)];
  assert.ok(Math.abs(at(10, 95) - 5) <= cell); // in the middle of a channel of 10 µm
  assert.equal(at(10, 50), 0); // in a wall
  await run.close();
});

test('a deforming channel', async (t) => {
  const run = await playTo(t, 'scenarios/papers/drrt/deforming_channel.yaml', 12, { speed: 20 });
  await run.picture('scene-channel');
  await run.close();
});

test('valves', async (t) => {
  const run = await playTo(t, 'scenarios/papers/radar/micromaze.yaml', 70, { speed: 20 });
  await run.scene((scene) => scene.show('obstacle-trails', true));
  await run.page.waitForTimeout(200);
  await run.picture('scene-valves');
  await run.close();
});

test('a retina', async (t) => {
  const run = await playTo(t, 'scenarios/demo.yaml', 20, { speed: 20 });
  await run.picture('scene-retina');
  await run.scene((scene) => scene.follow(true));
  await run.scene((scene) => scene.zoomBy(15));
  await run.page.waitForTimeout(300);
  await run.picture('scene-retina-close');
  await run.close();
});

test('robots with goals of their own', async (t) => {
  const run = await playTo(t, 'scenarios/papers/global/two_robots.yaml', 3, { speed: 2 });
  await run.picture('scene-two-robots');
  await run.close();
});

test('a photograph lies beneath the walls', async (t) => {
  const run = await playTo(t, 'scenarios/papers/gather/t_junction.yaml', 1, { speed: 2 });
  await run.scene(async (scene) => {
    const canvas = document.createElement('canvas');
    canvas.width = canvas.height = 200;
    const context = canvas.getContext('2d');
    const shade = context.createRadialGradient(100, 100, 10, 100, 100, 140);
    shade.addColorStop(0, '#f2a07a');
    shade.addColorStop(1, '#5a1d12');
    context.fillStyle = shade;
    context.fillRect(0, 0, 200, 200);
    const blob = await new Promise((resolve) => canvas.toBlob(resolve));
    scene.show('aggregation', false);
    await scene.setBackground(URL.createObjectURL(blob), [0, 50], 0.25);
  });
  await run.page.waitForTimeout(200);
  await run.picture('scene-photograph');
  await run.close();
});

test('zooms about the pointer, pans, fits', async (t) => {
  const run = await playTo(t, 'scenarios/papers/radar/twelve.yaml', 1, { speed: 4 });
  const box = await run.page.locator('.scene canvas').boundingBox();
  const at = [400, 300];
  const under = () => run.scene((scene, at) => scene.view.toWorld(at), at);
  const scale = () => run.scene((scene) => scene.view.scale);
  const before = { world: await under(), scale: await scale() };
  await run.page.mouse.move(box.x + at[0], box.y + at[1]);
  await run.page.mouse.wheel(0, -300);
  await until(run.page, () => window.microswarm.scene.view.scale > 0.3, { seconds: 5 });
  const close = await under();
  assert.ok((await scale()) > 1.5 * before.scale);
  for (const axis of [0, 1]) assert.ok(Math.abs(close[axis] - before.world[axis]) < 1e-6);

  await run.page.mouse.move(box.x + 640, box.y + 180); // nothing lies there
  const grabbed = await run.scene((scene) => scene.view.toWorld([640, 180]));
  await run.page.mouse.down();
  await run.page.mouse.move(box.x + 700, box.y + 240, { steps: 4 });
  await run.page.mouse.up();
  const dragged = await run.scene((scene) => scene.view.toWorld([700, 240]));
  for (const axis of [0, 1]) assert.ok(Math.abs(dragged[axis] - grabbed[axis]) < 1e-6);
  assert.deepEqual(await run.page.evaluate(() => window.touches), []);

  await run.scene((scene) => scene.fit());
  assert.equal(await scale(), before.scale);
  await run.close();
});

test('goal, start and obstacles are taken hold of', async (t) => {
  const run = await playTo(t, 'scenarios/papers/radar/twelve.yaml', 1, { speed: 4 });
  const box = await run.page.locator('.scene canvas').boundingBox();
  const screen = (world) => run.scene((scene, world) => scene.view.toScreen(world), world);
  const cursor = () => run.scene((scene) => scene.root.querySelector('canvas').style.cursor);
  const drag = async ([x, y], name) => {
    await run.page.mouse.move(box.x + x + 3, box.y + y - 2);
    assert.equal(await cursor(), 'grab');
    await run.page.mouse.down();
    await run.page.mouse.move(box.x + x + 43, box.y + y + 38, { steps: 5 });
    assert.equal(await cursor(), 'grabbing');
    await run.page.waitForTimeout(100);
    if (name) await run.picture(name);
    await run.page.mouse.up();
    return run.page.evaluate(() => window.touches.splice(0));
  };
  const disc = await run.page.evaluate(() => window.discs.slice(8, 12));
  const touches = await drag(await screen([disc[0], disc[1]]), 'scene-drag-obstacle');
  assert.deepEqual(touches[0].what, { kind: 'obstacle', index: disc[3] });
  // The start comes last: the page begins anew with it.
  const scale = await run.scene((scene) => scene.view.scale);
  for (const [kind, place] of [
    ['goal', [4700, 1200]],
    ['start', [300, 1200]],
  ]) {
    const touches = await drag(await screen(place), `scene-drag-${kind}`);
    assert.equal(touches[0].phase, 'begin');
    assert.equal(touches.at(-1).phase, 'end');
    assert.ok(touches.slice(1, -1).every(({ phase }) => phase === 'move'));
    const { what, from, at } = touches.at(-1);
    assert.deepEqual([what, from], [{ kind }, place]);
    const pixel = 1 / scale; // a press is rounded to pixels
    assert.ok(Math.abs(at[0] - place[0] - 40 / scale) <= pixel);
    assert.ok(Math.abs(at[1] - place[1] + 40 / scale) <= pixel);
  }
  await run.page.click('.loss .anew'); // the goal was moved while it ran
  await run.page.mouse.click(box.x + 640, box.y + 180);
  const clicks = await run.page.evaluate(() => window.touches.splice(0));
  assert.deepEqual(
    clicks.map(({ phase, what }) => [phase, what.kind]),
    [
      ['begin', 'map'],
      ['end', 'map'],
    ],
  );
  await run.close();
});

test('draws only when something changed', async (t) => {
  const run = await playTo(t, 'scenarios/papers/radar/twelve.yaml', 1, { speed: 4 });
  const pictures = () => run.scene((scene) => scene.pictures);
  let before;
  for (let tries = 0; before !== (before = await pictures()); ++tries) {
    assert.ok(tries < 20, 'it never stops drawing');
    await run.page.waitForTimeout(1000);
  }
  await run.scene((scene) => scene.show('radar', false));
  await run.page.waitForTimeout(1000);
  assert.equal(await pictures(), before + 1);
  const hidden = await run.scene((scene) => scene.layers().filter(({ shown }) => !shown));
  assert.deepEqual(
    hidden.map(({ name }) => name),
    ['clearance', 'obstacle-trails', 'radar', 'clock'],
  );
  await run.close();
});

test('ten thousand robots', async (t) => {
  const run = await playTo(t, 'scenarios/papers/gather/t_junction.yaml', 1, { speed: 2 });
  const rate = await drawRobots(run.page, 10_000, 4);
  t.diagnostic(`${rate.toFixed(1)} pictures a second`);
  await run.picture('scene-ten-thousand');
  assert.ok(rate > 0.2);
  await run.close();
});

test('what moves is between two frames while it plays, never beyond', async (t) => {
  const run = await playTo(t, 'scenarios/papers/radar/twelve.yaml', 1, { speed: 4 });
  const seen = await run.scene(async (scene) => {
    const none = new Uint8Array();
    const frame = (number, x_um) => ({
      type: 'frame',
      number,
      frame: { t_s: number / 10, x_um, y_um: 0, radius_um: 10, heading_rad: 0 },
      bodies: { discs: none, polygons: [] },
      robots: none,
      path: none,
      plans: 0,
    });
    const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
    const x = () => scene.shownAt(performance.now()).swarm.x;
    scene.take({ type: 'standing', plays: true, changes: [] });
    scene.take(frame(1000, 0));
    await wait(100);
    scene.take(frame(1001, 100));
    const onItsWay = [x()];
    await wait(40);
    onItsWay.push(x());
    await wait(400);
    const late = x();
    scene.take(frame(1002, 200)); // after a pause
    const jumped = x();
    await wait(60);
    scene.take(frame(1003, 300));
    scene.take({ type: 'standing', plays: false, changes: [] });
    return { onItsWay, late, jumped, paused: x() };
  });
  assert.ok(seen.onItsWay[0] < 20 && seen.onItsWay[1] > 20 && seen.onItsWay[1] <= 100);
  assert.deepEqual([seen.late, seen.jumped, seen.paused], [100, 200, 300]);
  await run.close();
});

test('moving the view ends to follow', async (t) => {
  const run = await playTo(t, 'scenarios/papers/radar/twelve.yaml', 1, { speed: 4 });
  const button = run.page.getByRole('button', { name: 'Follow' });
  await button.click();
  assert.equal(await button.getAttribute('aria-pressed'), 'true');
  const box = await run.page.locator('.scene canvas').boundingBox();
  await run.page.mouse.move(box.x + 640, box.y + 400);
  await run.page.mouse.down();
  await run.page.mouse.move(box.x + 500, box.y + 450, { steps: 4 });
  await run.page.mouse.up();
  assert.equal(await button.getAttribute('aria-pressed'), 'false');
  const moved = await run.scene((scene) => scene.view.origin);
  await run.page.evaluate(() => window.microswarm.connection.ask({ do: 'step' }));
  await run.page.waitForTimeout(300);
  assert.deepEqual(await run.scene((scene) => scene.view.origin), moved);
  await run.close();
});

test('requests are answered, also those that cannot be read and after the end', async (t) => {
  const run = await playTo(t, 'scenarios/papers/radar/twelve.yaml', 1, { speed: 4 });
  const asked = await run.page.evaluate(async () => {
    const { connection } = window.microswarm;
    const deep = { do: 'set', key: 'goal_um', value: [[[1]]] };
    const answers = await Promise.all([{ do: 'fly' }, deep].map((request) => connection.ask(request)));
    const waiting = connection.ask({ do: 'pause' });
    await fetch(`/api/sessions/${connection.session}`, { method: 'DELETE' });
    await waiting;
    while (!document.querySelector('.trouble').textContent) await new Promise((resolve) => setTimeout(resolve, 20));
    answers.push(await connection.ask({ do: 'pause' }));
    return answers.map(({ issues }) => issues.length);
  });
  assert.deepEqual(asked, [1, 1, 1]);
  await run.close();
});

test('two fingers zoom', async (t) => {
  const run = await playTo(t, 'scenarios/papers/radar/twelve.yaml', 1, { speed: 4 });
  const box = await run.page.locator('.scene canvas').boundingBox();
  const before = await run.scene((scene) => [scene.view.scale, ...scene.view.toWorld([640, 180])]);
  const fingers = await run.page.context().newCDPSession(run.page);
  const touch = (type, apart) =>
    fingers.send('Input.dispatchTouchEvent', {
      type,
      touchPoints: (apart ? [-apart, apart] : []).map((dx, id) => {
        return { x: box.x + 640 + dx, y: box.y + 180, id };
      }),
    });
  await touch('touchStart', 40);
  for (const apart of [50, 65, 80]) await touch('touchMove', apart);
  await touch('touchEnd');
  const after = await run.scene((scene) => [scene.view.scale, ...scene.view.toWorld([640, 180])]);
  assert.ok(Math.abs(after[0] / before[0] - 2) < 0.05);
  for (const i of [1, 2]) assert.ok(Math.abs(after[i] - before[i]) < 2 / before[0]);
  await run.close();
});

test('looking back', async (t) => {
  const run = await playTo(t, 'scenarios/first_flight.yaml', 15);
  await run.page.evaluate(() => window.microswarm.connection.ask({ do: 'seek', number: 80 }));
  await until(run.page, () => window.microswarm.scene.shownAt(performance.now()).number === 80, { seconds: 20 });
  await run.page.waitForTimeout(300);
  await run.picture('scene-back');
  await run.close();
});

test('the goal moves where it is set', async (t) => {
  const run = await playTo(t, 'scenarios/papers/radar/twelve.yaml', 1, { speed: 4 });
  await run.page.evaluate(() =>
    window.microswarm.connection.ask({ do: 'set', key: 'goal_um', value: '[4000, 600]' }),
  );
  const goal = () => {
    const { scene } = window.microswarm;
    return scene.hit(scene.view.toScreen([4000, 600])).what.kind === 'goal';
  };
  await until(run.page, goal, { seconds: 20 });
  await run.close();
});

test('a screen of double density', async (t) => {
  const run = await playTo(t, 'scenarios/papers/radar/micromaze.yaml', 1, { speed: 4 });
  const screen = await run.page.context().newCDPSession(run.page);
  const size = { width: 1000, height: 640 };
  const density = { deviceScaleFactor: 2, mobile: false };
  await screen.send('Emulation.setDeviceMetricsOverride', { ...size, ...density });
  const isSharp = () => {
    const { width, clientWidth } = document.querySelector('.scene canvas');
    return width === 2 * clientWidth;
  };
  await until(run.page, isSharp, { seconds: 10 });
  await run.page.waitForTimeout(500);
  const png = await run.scene(async (scene) => {
    const bytes = new Uint8Array(await (await scene.picture()).arrayBuffer());
    return Array.from(bytes, (byte) => String.fromCharCode(byte)).join('');
  });
  writeFileSync(join(root, 'build/web/scene-double.png'), Buffer.from(png, 'latin1'));
  assert.deepEqual([...Buffer.from(png.slice(1, 4), 'latin1')], [0x50, 0x4e, 0x47]);
  await run.close();
});
