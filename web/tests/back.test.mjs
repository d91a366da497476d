// SPDX-License-Identifier: Apache-2.0
// Looking back: of which time things are, and what a change does there. And for those without a pointer or sight.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { inLab as inLabOf, startBrowser, until } from './lab.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());
const inLab = (...rest) => inLabOf(browser, ...rest);

async function dragGoal(page) {
  const box = await page.locator('.scene canvas').boundingBox();
  const at = await page.evaluate(() => {
    const { scene, connection } = window.microswarm;
    return scene.view.toScreen(connection.hello.scenario.goal_um);
  });
  await page.mouse.move(box.x + at[0], box.y + at[1]);
  await page.mouse.down();
  await page.mouse.move(box.x + at[0] - 40, box.y + at[1] + 30, { steps: 4 });
  await page.mouse.up();
}

test('a change in the past asks whether it acts now or in a branch, and numbers say of when they are', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    const standing = () => page.evaluate(() => window.microswarm.connection.standing);
    await page.keyboard.press('k'); // the legend, which moves the map when it comes
    for (let i = 0; i < 12; ++i) await page.click('.step');
    await until(page, () => window.microswarm.connection.history.times.length === 12);
    assert.match(await page.locator('.total').innerText(), /of 1\.1 s/);
    await page.keyboard.press('Home');
    await until(page, () => window.microswarm.connection.standing.looks_back);
    await page.locator('.parameters .when', { hasText: 'values at 0.0 s' }).waitFor();
    await dragGoal(page);
    await page.waitForSelector('dialog.loss');
    await picture('back-asks');
    await page.click('.loss .keep');
    assert.deepEqual((await standing()).changes, []);
    await page.keyboard.press('ArrowRight');
    await until(page, () => window.microswarm.connection.standing.frame === 1);
    await page.keyboard.press('ArrowRight');
    await until(page, () => window.microswarm.connection.standing.frame === 2);
    await dragGoal(page);
    const first = await page.evaluate(() => location.hash);
    await page.click('.loss .branch');
    await until(page, (first) => location.hash !== first, { wanted: first });
    await until(page, () => window.microswarm?.connection.standing?.frames === 3);
    assert.match((await standing()).changes.join(), /^goal_um=/);
    await picture('back-branch');
    await page.goBack();
    await page.click('.loss .anew'); // only its record repeats the branch
    await until(page, () => window.microswarm?.connection.standing?.frames === 12);
    await page.keyboard.press('Home');
    await until(page, () => window.microswarm.connection.standing.looks_back);
    await dragGoal(page);
    await page.click('.loss .now');
    await until(page, () => window.microswarm.connection.standing.changes.length === 1);
    assert.equal((await standing()).looks_back, false);
    await page.getByRole('tab', { name: 'Record' }).click();
    assert.match(await page.locator('.record').innerText(), /its run is another one/);
  }));

test('marks of events are named under the pointer, listed, and reached by keys', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    for (let i = 0; i < 12; ++i) await page.click('.step');
    await until(page, () => window.microswarm.connection.history.times.length === 12);
    await page.evaluate(() => {
      const { connection } = window.microswarm;
      const { columns } = connection.history;
      const events = [{ t_s: 0.6, kind: 'contact_obstacle', x_um: 0, y_um: 0, clearance_um: null, body: 0 }];
      connection.take({ type: 'rows', columns: [...columns.keys()], rows: new Uint8Array(), events, anew: false });
    });
    const box = await page.locator('.marks').boundingBox();
    const times = await page.evaluate(() => window.microswarm.connection.history.times);
    const share = times.findIndex((one) => Math.abs(one - 0.6) < 1e-6) / (times.length - 1);
    await page.mouse.move(box.x + 7 + share * (box.width - 14), box.y + 6);
    await page.locator('.tip', { hasText: 'contact with obstacle' }).waitFor();
    await picture('time-line');
    await page.keyboard.press('N');
    await until(page, () => Math.abs(window.microswarm.connection.shown - 0.6) < 1e-6);
    await page.getByRole('tab', { name: 'Record' }).click();
    await page.locator('.events li', { hasText: 'contact with obstacle' }).waitFor();
  }));

test('the page is used by keys and told in words', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    assert.match(await page.locator('canvas[role=img]').first().getAttribute('aria-label'), /^Map/);
    assert.equal(await page.locator('.clock').getAttribute('aria-live'), 'off');
    assert.match(
      await page.locator('.field[data-key="goal_tolerance_um"] .slider').getAttribute('aria-valuetext'),
      /µm$/,
    );
    let stops = 0;
    while (stops < 20 && !(await page.evaluate(() => document.activeElement.matches('.play')))) {
      await page.keyboard.press('Tab');
      ++stops;
    }
    assert.ok(stops < 20, 'Play is soon reached');
    await page.click('.tool-obstacle');
    await page.keyboard.press('x');
    await until(page, () => window.microswarm.connection.hello.scenario.obstacles.length === 3);
    await page.setViewportSize({ width: 390, height: 800 });
    assert.ok(await page.locator('.timeline').evaluate((one) => one.clientWidth > 250));
    await picture('phone');
  }));

test('pages that are left leave nothing behind', () =>
  inLab('scenarios/first_flight.yaml', async (page) => {
    const session = await page.context().newCDPSession(page);
    const canvases = async () => {
      await session.send('HeapProfiler.collectGarbage');
      const { result } = await session.send('Runtime.evaluate', { expression: 'HTMLCanvasElement.prototype' });
      const { objects } = await session.send('Runtime.queryObjects', { prototypeObjectId: result.objectId });
      const counted = await session.send('Runtime.callFunctionOn', {
        objectId: objects.objectId,
        functionDeclaration: 'function () { return this.filter((one) => one.className === "marks").length; }',
        returnByValue: true,
      });
      return counted.result.value;
    };
    const visit = async () => {
      await page.getByRole('link', { name: '‹ Gallery' }).click();
      await page.click('.open-runs a');
      await until(page, () => document.querySelector('.form .field') !== null); // a handle would keep the page
    };
    await visit();
    const before = await canvases();
    for (let i = 0; i < 4; ++i) await visit();
    const now = await canvases();
    assert.ok(now <= before + 1, `time lines: ${before}, then ${now}`);
  }));
