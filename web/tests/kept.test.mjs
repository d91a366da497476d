// SPDX-License-Identifier: Apache-2.0
// Nothing that a person did is lost by a broken connection, a page that is left, or a way back.
import assert from 'node:assert/strict';
import { createServer, connect } from 'node:net';
import { after, before, test } from 'node:test';
import { inLab as inLabOf, openPage, startBrowser, startLab, until } from './lab.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());
const inLab = (...rest) => inLabOf(browser, ...rest);

/** A way to a lab that can be cut: { url, cut(), mend() }. */
async function cuttable(url) {
  const target = Number(new URL(url).port);
  const sockets = new Set();
  let isCut = false;
  const server = createServer((from) => {
    if (isCut) return from.destroy();
    const to = connect(target, '127.0.0.1');
    for (const one of [from, to]) {
      sockets.add(one);
      one.on('error', () => undefined);
      one.on('close', () => {
        sockets.delete(one);
        from.destroy();
        to.destroy();
      });
    }
    from.pipe(to).pipe(from);
  });
  await new Promise((resolve) => server.listen(0, '127.0.0.1', resolve));
  const way = new URL(url);
  way.port = server.address().port;
  return {
    url: way.href,
    cut: () => {
      isCut = true;
      for (const one of sockets) one.destroy();
    },
    mend: () => (isCut = false),
    close: () => server.close(),
  };
}

test('a stream that breaks is opened again, and the run goes on', async () => {
  const lab = await startLab('scenarios/first_flight.yaml');
  const way = await cuttable(lab.url);
  const { page, picture, close } = await openPage(browser, way.url);
  await page.waitForSelector('.form .field', { state: 'attached' });
  await page.fill('[id="field-goal_tolerance_um"]', '33');
  await page.keyboard.press('Enter');
  await until(page, () => window.microswarm.connection.standing.changes.length === 1);
  for (let i = 0; i < 3; ++i) await page.click('.step');
  await until(page, () => window.microswarm.connection.history.times.length === 3);
  way.cut();
  await page.locator('.top .trouble', { hasText: 'rying again' }).waitFor();
  assert.ok(await page.locator('.timebar').evaluate((one) => one.inert));
  await picture('stream-lost');
  await page.waitForTimeout(1500);
  way.mend();
  await page.waitForSelector('.session[data-stream="open"]');
  await until(page, () => document.querySelector('.top .trouble').textContent === '');
  await page.click('.step');
  await until(page, () => window.microswarm.connection.history.times.length === 4);
  assert.deepEqual(await page.evaluate(() => window.microswarm.connection.standing.changes), ['goal_tolerance_um=33']);
  await close(/net::ERR_|WebSocket/); // that it could not be reached
  way.close();
  assert.equal(await lab.stop(), 0);
});

test('leaving a run that was steered asks, and the gallery leads back to it', () =>
  inLab('scenarios/first_flight.yaml', async (page, { picture }) => {
    const gallery = page.getByRole('link', { name: '‹ Gallery' });
    await page.keyboard.press('m');
    await page.waitForSelector('[data-mode="manual"]');
    await page.click('.step');
    await page.keyboard.press('m');
    await page.waitForSelector('[data-mode="autonomous"]');
    await until(page, () => window.microswarm.connection.standing.steered);
    const asks = () =>
      page.evaluate(() => {
        const event = new Event('beforeunload', { cancelable: true });
        window.dispatchEvent(event);
        return event.defaultPrevented;
      });
    assert.ok(await asks());
    await gallery.click();
    await page.waitForSelector('dialog.loss');
    await picture('leave');
    await page.click('.loss .keep');
    assert.match(page.url(), /session\/\d+$/);
    assert.ok(await page.locator('.timebar').isVisible());
    await gallery.click();
    await page.click('.loss .anew');
    await page.locator('.open-runs a', { hasText: 'first_flight.yaml' }).waitFor();
    await picture('gallery-open-runs');
    assert.equal(await asks(), false);
    await page.click('.open-runs a');
    await until(page, () => window.microswarm?.connection.standing?.steered);
  }));

test('a run that is gone is said to be', () =>
  inLab('scenarios/first_flight.yaml', async (page, { complaints }) => {
    await page.evaluate(() => fetch(`/api/sessions/${window.microswarm.connection.session}`, { method: 'DELETE' }));
    await page.locator('.top .trouble', { hasText: 'closed' }).waitFor();
    await page.reload();
    await page.locator('.fault .trouble', { hasText: 'This run is closed' }).waitFor();
    await page.getByRole('link', { name: '‹ Gallery' }).click();
    await page.waitForSelector('.card');
    for (const one of complaints.splice(0)) assert.match(one, /404|WebSocket/);
  }));

test('a tab of a lab that ended does not join a run of the next lab at its port', async () => {
  let lab = await startLab('scenarios/first_flight.yaml');
  const port = new URL(lab.url).port;
  const { page, close } = await openPage(browser, lab.url);
  await page.waitForSelector('.form .field', { state: 'attached' });
  const before = page.url();
  await lab.stop();
  await page.locator('.top .trouble', { hasText: 'The lab has ended' }).waitFor();
  lab = await startLab('scenarios/papers/radar/twelve.yaml', '--port', port);
  const other = await page.context().newPage(); // which gives the browser the new lab's cookie
  await other.goto(lab.url);
  await other.waitForSelector('.form .field', { state: 'attached' });
  // Before the other page has the new token, the old one only hears that it is refused.
  await page.locator('.top .trouble', { hasText: /another one runs here now|was started again/ }).waitFor();
  await page.goto(before);
  await page.reload();
  await page.locator('.fault .trouble', { hasText: 'another one runs here now' }).waitFor();
  await page.getByRole('link', { name: '‹ Gallery' }).click();
  await page.waitForSelector('.session .play'); // the file of the new lab's command line
  assert.match(await page.title(), /twelve/i);
  await close(/net::ERR_|WebSocket|410|403/);
  assert.equal(await lab.stop(), 0);
});
