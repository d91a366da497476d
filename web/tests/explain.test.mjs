// SPDX-License-Identifier: Apache-2.0
// The picture explains itself: legend, words under the pointer, presentation, sliders that act while they are dragged.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { inLab, startBrowser, startLab, until } from './lab.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());

/** Plays until a time [s] and waits for it. */
async function playTo(page, time) {
  await page.evaluate((time) => {
    const { connection } = window.microswarm;
    void connection.ask({ do: 'speed', number: 0 });
    void connection.ask({ do: 'play', number: time });
  }, time);
  const stands = (time) => {
    const { shown, standing } = window.microswarm.connection;
    return shown >= time - 0.11 && !standing.plays;
  };
  await until(page, stands, { wanted: time, seconds: 120 });
}

/** Moves the pointer to a position [µm] relative to the swarm; the words there. */
async function saidAt(page, dx, dy) {
  const at = await page.evaluate(
    ([dx, dy]) => {
      const { scene } = window.microswarm;
      const { x, y } = scene.shownAt(performance.now()).swarm;
      return scene.view.toScreen([x + dx, y + dy]);
    },
    [dx, dy],
  );
  const box = await page.locator('.scene canvas').boundingBox();
  await page.mouse.move(box.x + at[0], box.y + at[1]);
  await page.waitForTimeout(250);
  return (await page.locator('.hover').isVisible()) ? page.locator('.hover').innerText() : '';
}

test('a newcomer reads why the radar turned', () =>
  inLab(browser, 'scenarios/papers/radar/twelve.yaml', async (page, { picture }) => {
    await playTo(page, 42);
    await page.getByRole('button', { name: 'Follow' }).click();
    await page.waitForTimeout(500);
    const legend = await page.locator('.legend').innerText();
    for (const words of ['obstacle', 'path travelled', 'screened by a wall', 'direction chosen', 'safety circle'])
      assert.ok(legend.includes(words), words);
    for (const words of ['search tree', 'region', 'robot']) assert.ok(!legend.includes(words), words);
    const all = [];
    for (let degrees = 0; degrees < 360; degrees += 10) {
      const [x, y] = [Math.cos((degrees * Math.PI) / 180), Math.sin((degrees * Math.PI) / 180)];
      all.push(await saidAt(page, 130 * x, 130 * y));
    }
    await picture('explained-radar');
    assert.ok(
      all.some((one) => /screened by obstacle \d+/.test(one)),
      all.join('\n'),
    );
    assert.ok(
      all.some((one) => /Chosen direction \d+°\n.*φ [\d.]+ of \d+ directions kept/.test(one)),
      all.join('\n'),
    );
    assert.match(await saidAt(page, 0, 0), /Swarm, a vortex\nRadius 100 µm, heading \d+°, speed [\d.]+ µm\/s/);
    await page.keyboard.press('k');
    assert.equal(await page.locator('.legend').evaluate((one) => one.open), false);
    await page.mouse.move(5, 5);
    await page.keyboard.press('i'); // the swarm is followed, so it is at the middle
    await page.locator('.hover', { hasText: 'Swarm' }).waitFor();
  }));

test('a presentation is the picture alone, and its link keeps it', () =>
  inLab(browser, 'scenarios/first_flight.yaml', async (page, { picture }) => {
    await playTo(page, 5);
    await page.getByRole('button', { name: 'Present' }).click();
    const isAlone = async () =>
      (await page.locator('.tabs').isHidden()) &&
      (await page.locator('.timebar').isHidden()) &&
      page.locator('.exit').isVisible();
    assert.ok(await isAlone());
    assert.match(page.url(), /\/present$/);
    assert.equal(await page.evaluate(() => window.microswarm.scene.view.bold), 1.8);
    await picture('presented');
    await page.reload();
    await page.locator('.exit').waitFor();
    assert.ok(await isAlone());
    await page.keyboard.press('Escape');
    await page.locator('.tabs').waitFor();
    assert.ok(!page.url().includes('present'));
    assert.equal(await page.evaluate(() => window.microswarm.scene.view.bold), 1);
  }));

test('the input of all robots is an arrow, and the gathered ones are counted', () =>
  inLab(browser, 'scenarios/papers/gather/t_junction.yaml', async (page, { picture }) => {
    await playTo(page, 6);
    const { at, now } = await page.evaluate(() => {
      const layer = window.microswarm.scene.listed.find(({ name }) => name === 'input');
      return { at: layer.at, now: layer.inputs.now };
    });
    assert.ok(now.speed >= 0);
    const box = await page.locator('.scene canvas').boundingBox();
    await page.mouse.move(box.x + at[0], box.y + at[1]);
    await page.locator('.hover', { hasText: 'Input of all robots' }).waitFor();
    await picture('common-input');
    await page.getByRole('tab', { name: 'Record' }).click();
    await page.locator('[data-metric="robots_at_the_goal"]').waitFor();
  }));

test('a slider acts while it is dragged, and the drag is one change', () =>
  inLab(browser, 'scenarios/first_flight.yaml', async (page) => {
    await page.click('.play');
    const slider = page.locator('.field[data-key="goal_tolerance_um"] .slider');
    await slider.scrollIntoViewIfNeeded();
    const before = await page.evaluate(() => window.microswarm.connection.hello.scenario.goal_tolerance_um);
    const { x, y, width, height } = await slider.boundingBox();
    await page.mouse.move(x + width * 0.5, y + height / 2);
    await page.mouse.down();
    for (let share = 0.5; share < 0.9; share += 0.02) {
      await page.mouse.move(x + width * share, y + height / 2);
      await page.waitForTimeout(30);
    }
    const acts = (before) => window.microswarm.connection.hello.scenario.goal_tolerance_um !== before;
    await until(page, acts, { wanted: before });
    await page.mouse.up();
    const listed = () =>
      window.microswarm.connection.standing.changes.filter((one) => one.startsWith('goal_tolerance')).length;
    await until(page, () => window.microswarm.connection.standing.changes.length > 0);
    assert.equal(await page.evaluate(listed), 1);
    await page.locator('.undo').click();
    await until(page, (before) => window.microswarm.connection.hello.scenario.goal_tolerance_um === before, {
      wanted: before,
    });
    assert.ok(await page.locator('.undo').isHidden(), 'one drag, one change');
  }));

test('a navigator is as published with one click, and ours again', () =>
  inLab(browser, 'scenarios/demo.yaml', async (page) => {
    const published = () => window.microswarm.connection.hello.scenario.navigator.as_published;
    await page.getByRole('button', { name: 'As published' }).click();
    await until(page, published, { seconds: 60 });
    const kept = await page.evaluate(() => window.microswarm.connection.hello.scenario.navigator);
    assert.equal(kept.clearance_um, 14);
    assert.notEqual(kept.extra_clearance_um, 3); // it is an addition
    await page.getByRole('button', { name: 'Ours' }).click();
    await until(page, () => window.microswarm.connection.hello.scenario.navigator.as_published === false, {
      seconds: 60,
    });
  }));

test('a tap says what is there, also on a phone', async () => {
  const lab = await startLab('scenarios/first_flight.yaml');
  const context = await browser.newContext({ viewport: { width: 390, height: 844 }, hasTouch: true });
  const page = await context.newPage();
  await page.goto(lab.url);
  await until(page, () => window.microswarm?.connection.standing && window.microswarm.scene.shownAt(0).swarm);
  assert.equal(await page.locator('.legend').evaluate((one) => one.open), false);
  const at = await page.evaluate(() => {
    const { scene } = window.microswarm;
    const [x, y] = scene.shownAt(0).discs;
    return scene.view.toScreen([x, y]);
  });
  const box = await page.locator('.scene canvas').boundingBox();
  await page.touchscreen.tap(box.x + at[0], box.y + at[1]);
  await page.locator('.hover', { hasText: /Obstacle \d+\s*A disc of radius/ }).waitFor();
  await context.close();
  await lab.stop();
});
