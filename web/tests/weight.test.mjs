// SPDX-License-Identifier: Apache-2.0
// What a page leaves behind, and what a long run costs it: counted, not timed.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { inLab as inLabOf, startBrowser, until } from './lab.mjs';

let browser;
before(async () => (browser = await startBrowser()));
after(() => browser.close());
const inLab = (...rest) => inLabOf(browser, ...rest);

test('twenty visits of a session leave no nodes, canvases or listeners behind', () =>
  inLab('scenarios/first_flight.yaml', async (page) => {
    const session = await page.context().newCDPSession(page);
    const counts = async () => {
      for (let i = 0; i < 3; ++i) await session.send('HeapProfiler.collectGarbage');
      return session.send('Memory.getDOMCounters');
    };
    const visit = async (tab) => {
      await page.getByRole('link', { name: '‹ Gallery' }).click();
      await page.click('.open-runs a');
      await until(page, () => document.querySelector('.form .field') !== null); // a handle would keep the page
      await page.getByRole('tab', { name: tab }).click();
    };
    const tabs = ['Parameters', 'Layers', 'Plots', 'Record'];
    for (const tab of tabs) await visit(tab);
    const before = await counts();
    for (let i = 0; i < 20; ++i) await visit(tabs[i % tabs.length]);
    const now = await counts();
    assert.ok(now.nodes < before.nodes + 1000, `nodes: ${before.nodes}, then ${now.nodes}`);
    assert.ok(
      now.jsEventListeners < before.jsEventListeners + 100,
      `listeners: ${before.jsEventListeners}, then ${now.jsEventListeners}`,
    );
    assert.ok(now.documents <= before.documents + 1);
  }));

test('a message of rows draws no more after a million rows than after twenty thousand', () =>
  inLab('scenarios/first_flight.yaml', async (page) => {
    await page.getByRole('tab', { name: 'Plots' }).click();
    const work = (rows) =>
      page.evaluate(async (rows) => {
        const { connection } = window.microswarm;
        const columns = ['t_s', 'clearance_um', 'avoidance_cost', 'step_time_s', 'goal_distance_um', 'planned'];
        const send = (from, to, anew) => {
          const numbers = new Float64Array(columns.length * (to - from));
          for (let i = from; i < to; ++i)
            numbers.set(
              [i / 10, 50 + 40 * Math.sin(i), Math.random(), 0.001, 9, Number(i % 7 === 0)],
              columns.length * (i - from),
            );
          const bytes = new Uint8Array(numbers.buffer);
          connection.take({ type: 'rows', columns, rows: bytes, events: [], anew });
        };
        const drawn = () => new Promise((resolve) => setTimeout(() => requestAnimationFrame(() => resolve()), 600));
        send(0, rows, true);
        await drawn();
        let calls = 0;
        const kept = [];
        for (const [owner, name] of [
          [CanvasRenderingContext2D.prototype, 'fillRect'],
          [CanvasRenderingContext2D.prototype, 'lineTo'],
          [Path2D.prototype, 'lineTo'],
        ]) {
          const own = owner[name];
          kept.push(() => (owner[name] = own));
          owner[name] = function (...rest) {
            ++calls;
            return own.apply(this, rest);
          };
        }
        send(rows, rows + 10, false);
        await drawn();
        for (const back of kept) back();
        return calls;
      }, rows);
    const [few, many] = [await work(20_000), await work(1_000_000)];
    assert.ok(few > 100, `${few} calls`); // something was drawn
    assert.ok(many < 1.5 * few, `${few} calls, then ${many}`);
  }));
