// Khronos' validator on GLB files; fails on errors and on warnings. Arguments: files.
import {readFileSync} from 'node:fs';
import validator from 'gltf-validator';

let bad = 0;
for (const file of process.argv.slice(2)) {
  const report = await validator.validateBytes(new Uint8Array(readFileSync(file)));
  const {numErrors, numWarnings, numInfos, messages} = report.issues;
  console.log(`${file}: ${numErrors} errors, ${numWarnings} warnings, ${numInfos} notes; ${report.info.totalTriangleCount} triangles`);
  for (const m of messages.slice(0, 20)) console.log(`  ${m.code} ${m.pointer || ''} ${m.message}`);
  if (numErrors || numWarnings) bad = 1;
}
process.exit(bad);
