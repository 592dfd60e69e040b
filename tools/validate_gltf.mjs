// Asks the Khronos validator about glTF files: `npm install gltf-validator`, then `node tools/validate_gltf.mjs FILE …`.
// Ends with 1 if it finds an error or a warning. Remarks about what may be unused are counted only.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join } from "node:path";

// The package lies where the command is run.
const validator = createRequire(join(process.cwd(), "package.json"))("gltf-validator");
let faults = 0;
for (const file of process.argv.slice(2)) {
  const beside = (uri) => new Uint8Array(readFileSync(join(dirname(file), decodeURIComponent(uri))));
  const options = { maxIssues: 0, externalResourceFunction: async (uri) => beside(uri) };
  const { issues } = await validator.validateBytes(new Uint8Array(readFileSync(file)), options);
  console.log(`${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ${issues.numInfos} remarks`);
  for (const { severity, code, pointer, message } of issues.messages) {
    if (severity < 2) console.log(`  ${code} ${pointer ?? ""}: ${message}`);
  }
  faults += issues.numErrors + issues.numWarnings;
}
process.exit(faults > 0 ? 1 : 0);
