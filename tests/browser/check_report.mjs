// Opens a report in headless Chromium and uses it as a reader would. Arguments: report.html, folder for screenshots.
import {chromium} from 'playwright-core';
import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join, resolve} from 'node:path';
import {pathToFileURL} from 'node:url';

const [report, folder] = process.argv.slice(2).map(p => resolve(p));
const profile = mkdtempSync(join(tmpdir(), 'formwork-browser-'));
const failures = [];
const expect = (ok, what) => { console.log(`${ok ? 'ok  ' : 'FAIL'} ${what}`); if (!ok) failures.push(what); };

const context = await chromium.launchPersistentContext(profile, {
  executablePath: process.env.CHROMIUM || '/usr/bin/chromium', headless: true, viewport: {width: 1280, height: 900},
  args: ['--no-sandbox', '--disable-gpu', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--disable-background-networking',
         '--disable-component-update', '--disable-sync', '--no-first-run'],
});

const nameOf = panel => `P${String(panel + 1).padStart(2, '0')}`;

/// Share of the canvas's pixels that are drawn, and how many different colours there are.
const look = page => page.evaluate(() => {
  const canvas = document.querySelector('#canvas-box canvas'), copy = document.createElement('canvas');
  copy.width = 200; copy.height = 200;
  const pen = copy.getContext('2d');
  pen.drawImage(canvas, 0, 0, 200, 200);
  const d = pen.getImageData(0, 0, 200, 200).data, colours = new Set();
  let drawn = 0;
  for (let i = 0; i < d.length; i += 4) if (d[i + 3] > 0) { ++drawn; colours.add((d[i] >> 4) << 8 | (d[i + 1] >> 4) << 4 | d[i + 2] >> 4); }
  return {drawn: drawn / 40000, colours: colours.size, sum: d.reduce((a, b) => (a * 31 + b) % 1e9, 7)};
});

/// Marks behind the bag are hidden: a bag whose singularities lie at its foot is looked at from below.
async function turnUntilSeen(page, label) {
  await page.focus('#canvas-box canvas');
  for (let turn = 0; turn < 24 && !await page.$$eval(label, m => m.length === 0 || m.some(x => !x.hidden)); ++turn) {
    await page.keyboard.press('ArrowDown');
    await page.waitForTimeout(250);   // they are asked of the triangles once the view rests
  }
}

async function open(options) {
  const page = await context.newPage();
  const trouble = [];
  page.on('console', m => { if (['error', 'warning'].includes(m.type()) && !/GPU stall|swiftshader/i.test(m.text())) trouble.push(m.text()); });
  page.on('pageerror', e => trouble.push(String(e)));
  page.on('request', r => { if (!/^(file|data|blob):/.test(r.url())) trouble.push('asks for ' + r.url()); });
  await page.setViewportSize(options.size);
  await page.emulateMedia({colorScheme: options.scheme, reducedMotion: 'reduce'});
  await page.goto(pathToFileURL(report).href);
  await page.waitForTimeout(600);
  return {page, trouble};
}

try {
  const {page, trouble} = await open({size: {width: 1280, height: 900}, scheme: 'light'});
  const first = await look(page);
  expect(first.drawn > 0.03 && first.colours > 20, `the canvas shows a shaded bag (${(100 * first.drawn).toFixed(1)} % drawn, ${first.colours} colours)`);
  await page.screenshot({path: join(folder, 'light.png')});
  for (const id of ['flat', 'figures', 'convergence', 'pictures', 'model', 'sewing'])
    if (await page.isVisible('#' + id)) await page.locator('#' + id).screenshot({path: join(folder, `light-${id}.png`)});

  for (const key of await page.$$eval('#shapes button', b => b.map(x => x.dataset.shape))) {
    await page.click(`#shapes button[data-shape="${key}"]`);
    for (const field of await page.$$eval('#colour-by option', o => o.map(x => x.value))) await page.selectOption('#colour-by', field);
    await page.waitForTimeout(150);
    expect((await look(page)).drawn > 0.03, `the shape "${key}" is drawn in every colouring`);
  }
  for (const box of await page.$$('#toggles input')) {
    await page.waitForTimeout(200);
    const label = '.' + (await box.getAttribute('id')).slice(5);
    if (/mark/.test(label) && await box.isChecked()) await turnUntilSeen(page, label);
    const before = await look(page);
    before.hidden = /mark|tag/.test(label) && await page.$$eval(label, m => !m.every(x => x.hidden));
    await box.click();
    await page.waitForTimeout(400);
    const name = await box.getAttribute('id'), after = await look(page);
    // The marks are page elements over the canvas: they are asked by their visibility.
    const changed = /mark|tag/.test(name) ? await page.$$eval('.' + name.slice(5), m => m.every(x => x.hidden)) === before.hidden || await page.$$eval('.' + name.slice(5), m => m.length === 0) : after.sum !== before.sum;
    expect(changed, `${name} changes the view`);
    await box.click();
  }
  await page.focus('#canvas-box canvas');
  await page.keyboard.press('r');
  if (await page.$('#show-cross')) {
    await page.check('#show-cross');
    await page.waitForTimeout(200);
    await page.screenshot({path: join(folder, 'cross.png')});
    await page.uncheck('#show-cross');
  }
  if (await page.$('.piece')) {
    await page.selectOption('#colour-by', 'panel');
    const box = await (await page.$('#canvas-box canvas')).boundingBox();
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    await page.waitForTimeout(200);
    expect(/^Panel P\d+$/.test(await page.textContent('#panel-card h3')), 'a click on the bag shows the panel');
    expect(await page.$('#panel-card svg path') !== null, 'with its flat piece');
    expect((await page.textContent('#readout')).length > 0, 'the readout says what lies under the pointer');
    await page.screenshot({path: join(folder, 'chosen.png')});
    const neighbour = await page.$('#panel-card [data-neighbour]:not([data-neighbour="-1"])');
    if (neighbour) {
      const id = Number(await neighbour.getAttribute('data-neighbour'));
      await neighbour.click();
      expect(await page.textContent('#panel-card h3') === `Panel ${nameOf(id)}`, 'a click on a neighbour goes there');
    }
    await page.focus('.piece');
    await page.keyboard.press('Enter');
    const chosen = Number(await page.getAttribute('.piece', 'data-panel'));
    expect(await page.textContent('#panel-card h3') === `Panel ${nameOf(chosen)}`, 'Enter on a flat piece chooses it');
  }
  await page.focus('#canvas-box canvas');
  const still = await look(page);
  for (const key of ['ArrowLeft', 'ArrowUp', '+']) await page.keyboard.press(key);
  await page.waitForTimeout(200);
  expect((await look(page)).sum !== still.sum, 'the keys turn and zoom the view');
  await page.click('#theme');
  expect(await page.evaluate(() => document.documentElement.dataset.theme) === 'dark', 'the theme button turns to dark');
  expect(trouble.length === 0, 'no console error, no request' + trouble.map(t => '\n       ' + t).join(''));
  await page.close();

  for (const [name, size, scheme] of [['dark', {width: 1280, height: 900}, 'dark'], ['narrow', {width: 360, height: 740}, 'light'],
                                      ['narrow-dark', {width: 360, height: 740}, 'dark']]) {
    const other = await open({size, scheme});
    const wide = await other.page.evaluate(() => document.documentElement.scrollWidth - window.innerWidth);
    expect(wide <= 0, `${name}: nothing stands out of the page (${wide} px)`);
    await other.page.screenshot({path: join(folder, name + '.png')});
    for (const id of ['view', 'flat', 'figures', 'pictures'])
      if (await other.page.isVisible('#' + id)) await other.page.locator('#' + id).screenshot({path: join(folder, `${name}-${id}.png`)});
    expect((await look(other.page)).drawn > 0.03, `${name}: the canvas is not blank`);
    expect(other.trouble.length === 0, `${name}: no console error` + other.trouble.map(t => '\n       ' + t).join(''));
    await other.page.close();
  }
} finally {
  await context.close();
  rmSync(profile, {recursive: true, force: true});
}
console.log(failures.length ? `${failures.length} checks failed` : 'all checks passed');
process.exit(failures.length ? 1 : 0);
