// SPDX-License-Identifier: Apache-2.0
// What a person does around the scene: time, parameters, plots, record.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { inLab as inLabOf, openPage, program, root, startBrowser, startLab, until } from './lab.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());

const inLab = (...rest) => inLabOf(browser, ...rest);
const clock = async (page) => Number.parseFloat(await page.locator('.clock').innerText());
test('keys play, tick, seek, change the speed and show themselves', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    await page.keyboard.press('.');
    await page.keyboard.press('.');
    await until(page, () => document.querySelector('.scrub').max >= 1);
    await page.keyboard.press('+');
    await until(page, () => document.querySelector('.speed').value === '2');
    await page.keyboard.press('Space');
    await until(page, () => Number.parseFloat(document.querySelector('.clock').value) > 2);
    await page.keyboard.press('Space');
    await until(page, () => document.querySelector('.play').textContent.includes('Play'));
    const there = await clock(page);
    await page.keyboard.press('Home');
    await until(page, () => Number.parseFloat(document.querySelector('.clock').value) < 0.3);
    await page.keyboard.press('ArrowRight');
    await page.keyboard.press('End');
    await until(page, (t) => Number.parseFloat(document.querySelector('.clock').value) >= t, { wanted: there });
    await page.keyboard.press('?');
    await page.waitForSelector('dialog[open]');
    await picture('keys');
    await page.keyboard.press('Escape');
    await page.keyboard.press('m');
    await page.waitForSelector('[data-mode="manual"]');
    await page.keyboard.press('m');
    await page.waitForSelector('[data-mode="autonomous"]');
  }));

test('a key is not lost before the session has answered', async () => {
  const lab = await startLab('scenarios/first_flight.yaml');
  const tickAtOnce = () => {
    const observer = new MutationObserver(() => {
      if (!document.querySelector('.timebar')) return;
      observer.disconnect();
      for (let tick = 0; tick < 2; ++tick)
        document.body.dispatchEvent(new KeyboardEvent('keydown', { key: '.', bubbles: true }));
    });
    observer.observe(document, { childList: true, subtree: true });
  };
  const { page, close } = await openPage(browser, lab.url, undefined, tickAtOnce);
  await page.waitForSelector('.timebar');
  await until(page, () => document.querySelector('.scrub').max >= 1);
  await close();
  assert.equal(await lab.stop(), 0);
});

test('the time line is as long as the rows, also when they follow the standing that counts them', () =>
  inLab('scenarios/first_flight.yaml', async (page) => {
    await page.evaluate(() => {
      const { connection } = window.microswarm;
      connection.take({ ...connection.standing, frame: 2, frames: 3 });
      const rows = new Uint8Array(new Float64Array([0.1, 0.2, 0.3]).buffer);
      connection.take({ type: 'rows', columns: ['t_s'], rows, events: [], anew: true });
    });
    assert.deepEqual(await page.locator('.scrub').evaluate(({ max, value }) => [max, value]), ['2', '2']);
  }));

test('one scrubs over what was recorded, and a click in a plot seeks', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    await page.selectOption('.speed', '0');
    await page.click('.play');
    await page.waitForSelector('[data-status="solved"]', { timeout: 120_000 });
    const end = await clock(page);
    await page.locator('.scrub').evaluate((slider) => {
      slider.value = String(Math.round(slider.max / 2));
      slider.dispatchEvent(new Event('input'));
    });
    const nearMiddle = (t) => Math.abs(Number.parseFloat(document.querySelector('.clock').value) - t / 2) < 0.3;
    await until(page, nearMiddle, { wanted: end });
    await page.getByRole('tab', { name: 'Plots' }).click();
    const plot = page.locator('.plots .u-over').first();
    const box = await plot.boundingBox();
    await page.mouse.move(box.x + box.width * 0.25, box.y + box.height / 2);
    await page.mouse.click(box.x + box.width * 0.25, box.y + box.height / 2);
    await until(page, (t) => Number.parseFloat(document.querySelector('.clock').value) < 0.45 * t, { wanted: end });
    await page.mouse.move(box.x + box.width * 0.6, box.y + box.height / 2);
    await page.waitForSelector('.tip:not([hidden])');
    await picture('scrub');
    await page.click('.live');
    await until(page, (t) => Number.parseFloat(document.querySelector('.clock').value) >= t, { wanted: end });
  }));

test('a slider changes the parameter, and the change is listed and in the command', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    const key = 'navigator.speed_um_per_s';
    const row = page.locator(`.field[data-key="${key}"]`);
    await page.fill('.parameters .search', 'commanded speed');
    const before = await row.locator('.number').inputValue();
    await row.locator('.slider').focus();
    for (let i = 0; i < 5; ++i) await page.keyboard.press('ArrowLeft');
    const after = await row.locator('.number').inputValue();
    assert.notEqual(after, before);
    await page.getByRole('tab', { name: 'Record' }).click();
    await page.locator('.changes', { hasText: `${key}=${after}` }).waitFor();
    assert.match(await page.locator('.command').innerText(), new RegExp(`microswarm run .*--set ${key}=${after}`));
    await picture('record');

    await page.selectOption('.speed', '0');
    await page.click('.play');
    await page.waitForSelector('[data-status="solved"]', { timeout: 120_000 });
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('a[download="record.h5"]')]);
    const record = join(root, 'build/web/panels.h5');
    await download.saveAs(record);
    assert.match(execFileSync(program, ['replay', record], { cwd: root }).toString(), /identical/);
  }));

test('a record is played and scrubbed, and its parameters only shown', () =>
  inLab('build/web/panels.h5', async (page, { picture }) => {
    await page.keyboard.press('Space');
    await until(page, () => Number.parseFloat(document.querySelector('.clock').value) > 1);
    await page.keyboard.press('Space');
    await page.keyboard.press('Home');
    await until(page, () => Number.parseFloat(document.querySelector('.clock').value) < 0.5);
    assert.ok(await page.locator('[id="field-seed"]').isDisabled());
    assert.ok(await page.locator('.tool-wall').isHidden());
    await picture('playback');
  }));

test('a run that ended begins again; one that was touched asks first', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    const play = page.locator('.play');
    await page.selectOption('.speed', '0');
    await play.click();
    await page.waitForSelector('[data-status="solved"]', { timeout: 120_000 });
    await page.keyboard.press('Home');
    assert.match(await play.innerText(), /Restart/);
    // The second run may be over before one could look at its status.
    await page.evaluate(() => {
      window.statuses = [];
      window.microswarm.connection.listen((message) => {
        if (message.type === 'standing') window.statuses.push(message.status);
      });
    });
    await play.click();
    await until(page, () => window.statuses.join().includes('running,solved'), { seconds: 120 });
    await page.selectOption('.speed', '1');
    await play.click();
    await until(page, () => window.microswarm.connection.standing.plays);
    await page.keyboard.press('m');
    await page.waitForSelector('[data-mode="manual"]');
    await page.keyboard.press('Space');
    const frames = () => page.evaluate(() => window.microswarm.connection.standing.frames);
    await until(page, () => !window.microswarm.connection.standing.plays);
    const before = await frames();
    await page.getByRole('tab', { name: 'Record' }).click();
    await page.click('.record .compare');
    await page.waitForSelector('dialog.loss');
    await picture('loss');
    await page.click('.loss .keep');
    await page.locator('.top .trouble', { hasText: 'continues' }).waitFor();
    assert.equal(await frames(), before);
    await page.click('.record .compare');
    await page.click('.loss .anew');
    await page.waitForSelector('.side[data-side="B"] .scene');
  }));

test('two equal runs that are paused stand at one time', () =>
  inLab(
    'scenarios/first_flight.yaml',
    async (page) => {
      await page.getByRole('tab', { name: 'Record' }).click();
      await page.click('.record .compare');
      await page.waitForSelector('.side[data-side="B"] .scene');
      await page.selectOption('.speed', '5');
      let before = 0;
      for (let i = 0; i < 4; ++i) {
        await page.keyboard.press('Space');
        const goesOn = (before) =>
          Number(document.querySelector('tr[data-metric="time_s"] td')?.textContent) > before + 0.5; // no table at first
        await until(page, goesOn, { wanted: before });
        await page.keyboard.press('Space');
        await until(page, () => {
          const cells = [...document.querySelectorAll('tr[data-metric="time_s"] td')].map((one) => one.textContent);
          const stands = document.querySelector('.play').textContent.includes('Play');
          return stands && cells[0] === cells[1];
        });
        await page.waitForTimeout(300);
        const cells = await page.locator('tr[data-metric="time_s"] td').allInnerTexts();
        assert.equal(cells[0], cells[1]); // and stays there
        before = Number(cells[0]);
      }
    },
    '--set',
    'swarm.max_speed_um_per_s=5',
    '--set',
    'time_limit_s=3600',
  )); // does not end meanwhile on a busy machine

test('a lab that ended is told', async () => {
  const lab = await startLab('scenarios/first_flight.yaml');
  const { page, close } = await openPage(browser, lab.url);
  await page.waitForSelector('.form .field', { state: 'attached' });
  await lab.stop('SIGKILL');
  await page.locator('.top .trouble', { hasText: 'The lab has ended' }).waitFor();
  assert.ok(await page.evaluate(() => document.querySelector('.timebar').inert));
  await close(/net::ERR_/); // that it could not be reached
});

test('two runs stand side by side with their difference', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    await page.getByRole('tab', { name: 'Record' }).click();
    await page.click('.record .compare');
    await page.waitForSelector('.side[data-side="B"] .scene');
    await page.getByRole('tab', { name: 'Parameters B' }).click();
    const row = page.locator('[role=tabpanel]:not([hidden]) .field[data-key="navigator.speed_um_per_s"]');
    await row.locator('.number').fill('40');
    await page.keyboard.press('Enter');
    await page.locator('.side[data-side="B"] .own', { hasText: '40' }).waitFor();
    await page.getByRole('tab', { name: 'Metrics' }).click();
    await page.selectOption('.speed', '0');
    await page.click('.play');
    for (const side of ['A', 'B'])
      await page.waitForSelector(`.side[data-side="${side}"][data-status="solved"]`, { timeout: 120_000 });
    const cells = await page.locator('tr[data-metric="time_s"] td').allInnerTexts();
    assert.ok(Number(cells[1]) > Number(cells[0]), cells.join());
    assert.ok(Math.abs(Number(cells[2]) - (Number(cells[1]) - Number(cells[0]))) < 0.1, cells.join());
    await picture('compare');
    await page.getByRole('tab', { name: 'Plots' }).click();
    await page.waitForTimeout(400);
    const over = await page.locator('.plots .u-over').first().boundingBox();
    await page.mouse.click(over.x + over.width / 2, over.y + over.height / 2);
    await until(page, () => document.querySelector('.scrub').value !== document.querySelector('.scrub').max);
    await picture('compare-plots');
  }));

/** Where a point of the map is in the window. */
async function onScreen(page, [x, y]) {
  const box = await page.locator('.scene canvas').boundingBox();
  const { view } = await page.evaluate(() => {
    const { scale, x, y } = window.microswarm.scene.view;
    return { view: { scale, x, y } };
  });
  return [box.x + view.x + view.scale * x, box.y + view.y - view.scale * y];
}

async function drag(page, from, to) {
  await page.mouse.move(...(await onScreen(page, from)));
  await page.mouse.down();
  await page.mouse.move(...(await onScreen(page, to)), { steps: 5 });
  await page.mouse.up();
}

test('an obstacle dragged into the way changes the path; discs come and go', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    const changes = () => page.evaluate(() => window.microswarm.connection.standing?.changes ?? []);
    await page.evaluate(() => {
      const { connection } = window.microswarm;
      connection.listen((message) => {
        if (message.type === 'frame') window.path = message.path;
      });
    });
    for (let i = 0; i < 3; ++i) await page.click('.step');
    await until(page, () => window.path?.length > 0);
    const before = await page.evaluate(() => window.path.join());
    // Obstacle 1 swings about (1450, 500); at t = 0 it is there or near.
    const place = await page.evaluate(() => {
      const { discs } = window.microswarm.scene.motion.newest;
      return [discs[4], discs[5]];
    });
    await drag(page, place, [600, 560]);
    await until(page, () => window.microswarm.connection.standing.changes.length === 1);
    assert.match((await changes())[0], /^obstacles\.1\.motion\.centre_um=\[/);
    for (let i = 0; i < 30; ++i) await page.click('.step');
    await until(page, (was) => window.path.join() !== was, { wanted: before });
    await picture('dragged');

    await page.click('.tool-obstacle');
    await page.mouse.click(...(await onScreen(page, [1500, 850])));
    await until(page, () => window.microswarm.connection.hello.scenario.obstacles.length === 3);
    await page.click('.tool-remove');
    await page.mouse.click(...(await onScreen(page, [1500, 850])));
    await until(page, () => window.microswarm.connection.hello.scenario.obstacles.length === 2);
    await page.keyboard.press('Escape');
    await drag(page, [1800, 500], [1700, 300]);
    await until(page, () => Math.abs(window.microswarm.connection.hello.scenario.goal_um[0] - 1700) < 5);
    await page.click('.tool-wall');
    await page.mouse.click(...(await onScreen(page, [300, 850])));
    await page.click('.loss .anew');
    await until(page, () => window.microswarm.connection.hello.scenario.map.discs.length === 1);
    await picture('touched');
    await page.keyboard.press('Escape');
    await drag(page, [200, 500], [200, 700]);
    await until(page, () => Math.abs(window.microswarm.connection.hello.scenario.start.y_um - 700) < 5);
    // The restarts kept what was changed before.
    assert.ok(Math.abs((await page.evaluate(() => window.microswarm.connection.hello.scenario.goal_um[0])) - 1700) < 5);
  }));

test('arrow keys and a gamepad steer', () =>
  inLab('scenarios/first_flight.yaml', async (page) => {
    await page.keyboard.press('m');
    await page.waitForSelector('[data-mode="manual"]');
    await page.click('.play');
    await page.locator('.clock').click();
    await page.keyboard.down('ArrowUp');
    await until(page, () => {
      const y = window.microswarm.connection.history.column('y_um');
      return y.length > 0 && y[y.length - 1] > 520;
    });
    await page.keyboard.up('ArrowUp');
    const turn = await page.evaluate(() => window.microswarm.connection.history.times.length);
    await page.evaluate(() => (navigator.getGamepads = () => [{ connected: true, axes: [0, 1] }]));
    await until(
      page,
      (since) => {
        const y = window.microswarm.connection.history.column('y_um').slice(since);
        return y.length > 10 && y[y.length - 1] < y[0] - 10;
      },
      { wanted: turn },
    );
  }));

test('the gallery has a picture for every experiment, and finds', async () => {
  const lab = await startLab();
  const lookedAt = await openPage(browser, lab.url);
  const { page } = lookedAt;
  await page.waitForSelector('.card img');
  await page.waitForTimeout(1500);
  await lookedAt.picture('gallery');
  await page.fill('.search', 'twelve radar');
  assert.ok((await page.locator('.card:visible').count()) >= 1);
  await page.fill('.search', 'zzzz');
  assert.equal(await page.locator('.card:visible').count(), 0);
  await lookedAt.close();
  await lab.stop();
});

test('the dark page and its layers', () =>
  inLab('scenarios/papers/radar/twelve.yaml', async (page, { picture }) => {
    await page.getByRole('button', { name: 'Light or dark' }).click();
    await page.selectOption('.speed', '20');
    await page.click('.play');
    await until(page, () => Number.parseFloat(document.querySelector('.clock').value) > 15);
    await page.click('.play');
    await page.getByRole('tab', { name: 'Layers' }).click();
    const radar = page.locator('.layer[data-layer="radar"] input');
    assert.equal(await radar.isChecked(), true);
    await radar.click();
    assert.equal(
      await page.evaluate(() => window.microswarm.scene.layers().find(({ name }) => name === 'radar').shown),
      false,
    );
    await radar.click();
    await page.waitForTimeout(300);
    await picture('dark-layers');
    await page.getByRole('tab', { name: 'Plots' }).click();
    await page.waitForTimeout(300);
    await picture('dark-plots');
  }));
