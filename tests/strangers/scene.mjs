// GLB files in two readers: Khronos' own validator, which may find neither errors nor warnings, and three.js, on which most viewers of the
// web are built: it plays the animation, and every surface of every star has to move. Usage: node scene.mjs FILE..., with NODE_PATH at both.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const packages = resolve(process.env.NODE_PATH);
const validator = createRequire(packages + "/")("gltf-validator");
const three = (path) => import(pathToFileURL(join(packages, "three", path)).href);
const { AnimationMixer } = await three("build/three.module.js");
const { GLTFLoader } = await three("examples/jsm/loaders/GLTFLoader.js");

/** When it is looked at, s, and how far everything has come by then: the animation takes two seconds. */
const [AT, COME] = [1.999, 0.9995];

/** What is wrong with how three.js plays the file's animation, and how many surfaces of how many stars it moves. */
async function played(bytes) {
    const { scene, animations } = await new GLTFLoader().parseAsync(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength), "");
    const faults = [];
    const { warn, error } = console;
    console.warn = console.error = (...words) => faults.push(words.filter((word) => typeof word === "string").join(" "));
    const mixer = new AnimationMixer(scene);
    for (const clip of animations) mixer.clipAction(clip).play();
    mixer.setTime(AT);
    Object.assign(console, { warn, error });
    const moving = [];
    scene.traverse((part) => {
        if (part.morphTargetInfluences) moving.push(part);
    });
    for (const { name, morphTargetInfluences } of moving) {
        for (const share of morphTargetInfluences) {
            if (!(Math.abs(share - COME) < 1e-6)) faults.push(`${name} has come to ${share} at ${AT} s instead of ${COME}`);
        }
    }
    if (moving.length > 0 !== animations.length > 0) faults.push(`${moving.length} surfaces could move, in ${animations.length} animations`);
    return { faults, surfaces: moving.length, stars: new Set(moving.map((part) => part.parent.uuid)).size };
}

let failed = false;
for (const file of process.argv.slice(2)) {
    const bytes = new Uint8Array(readFileSync(file));
    const { issues, info } = await validator.validateBytes(bytes, { maxIssues: 20 });
    const { faults, surfaces, stars } = await played(bytes);
    if (issues.numErrors + issues.numWarnings + faults.length > 0) {
        failed = true;
        console.error(`${file}: ${issues.numErrors} errors, ${issues.numWarnings} warnings, ${faults.length} faults in three.js`);
        for (const { code, message, pointer } of issues.messages.filter((issue) => issue.severity < 2)) {
            console.error(`  ${code} ${pointer}: ${message}`);
        }
        for (const fault of faults) console.error(`  three.js: ${fault}`);
    } else {
        console.log(`${file}: valid, ${info.totalTriangleCount} triangles, ${info.drawCallCount} meshes, ${issues.numInfos} hints; three.js moves ${surfaces} surfaces of ${stars} stars`);
    }
}
process.exit(failed ? 1 : 0);
