// Khronos' own validator on GLB files: neither errors nor warnings. Usage: node scene.mjs FILE..., with NODE_PATH at its package.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { resolve } from "node:path";

const validator = createRequire(resolve(process.env.NODE_PATH) + "/")("gltf-validator");
let failed = false;
for (const file of process.argv.slice(2)) {
    const { issues, info } = await validator.validateBytes(new Uint8Array(readFileSync(file)), { maxIssues: 20 });
    if (issues.numErrors + issues.numWarnings > 0) {
        failed = true;
        console.error(`${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings`);
        for (const { code, message, pointer } of issues.messages.filter((issue) => issue.severity < 2)) {
            console.error(`  ${code} ${pointer}: ${message}`);
        }
    } else {
        console.log(`${file}: valid, ${info.totalTriangleCount} triangles, ${info.drawCallCount} meshes, ${issues.numInfos} hints`);
    }
}
process.exit(failed ? 1 : 0);
