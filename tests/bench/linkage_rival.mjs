// The linkage and the drivers' values of each frame, as linkage.cpp writes them, solved by closed-chain-ik.
//
//     node linkage_rival.mjs <folder of the package> <file>
//
// Prints, for its default settings and for tight ones: microseconds a frame, and the largest gap of a closure.
import { readFileSync } from 'node:fs';
import { pathToFileURL } from 'node:url';

const [, , folder, file] = process.argv;
const { Solver, Joint, Link, DOF } = await import(pathToFileURL(`${folder}/src/core/index.js`));
const task = JSON.parse(readFileSync(file, 'utf8'));

/// The shortest rotation from Z to an axis.
function from_z([x, y, z]) {
    if (z < -1 + 1e-12) return [1, 0, 0, 0];
    const size = Math.hypot(-y, x, 1 + z);
    return [-y / size, x / size, 0, (1 + z) / size];
}
function product([ax, ay, az, aw], [bx, by, bz, bw]) {
    return [aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz];
}

function build() {
    const root = new Link(), links = [], driven = new Map();
    const link_of = index => index < 0 ? root : links[index];
    task.links.forEach(({ parent, joint, at, axis }, index) => {
        const hinge = new Joint(), link = new Link();
        for (const frame of [hinge, link]) {
            frame.setPosition(...at);
            frame.setQuaternion(...(joint === 'ball' ? [0, 0, 0, 1] : from_z(axis)));
        }
        // A driver's joint is moved from outside: nothing to solve for.
        const free = { hinge: [DOF.EZ], slider: [DOF.Z], ball: [DOF.EX, DOF.EY, DOF.EZ] }[joint];
        hinge.setDoF(...(task.drivers.includes(index) ? [] : free));
        link_of(parent).attachChild(hinge);
        hinge.attachChild(link);
        links.push(link);
        if (task.drivers.includes(index))
            driven.set(index, { hinge, joint, position: [...hinge.position], quaternion: [...hinge.quaternion] });
    });
    const ends = task.closures.map(({ first, second, at }) => {
        const joint = new Joint(), fixed = new Joint(), end = new Link();
        for (const frame of [joint, fixed, end]) frame.setPosition(...at);
        joint.setDoF(...(task.planar ? [DOF.EZ] : [DOF.EX, DOF.EY, DOF.EZ]));
        fixed.setDoF();
        link_of(first).attachChild(joint);
        link_of(second).attachChild(fixed);
        fixed.attachChild(end);
        joint.makeClosure(end);
        return [joint, end];
    });
    return { root, driven, ends };
}

function drive(driven, values) {
    task.drivers.forEach((index, k) => {
        const { hinge, joint, position, quaternion } = driven.get(index);
        const by = values[k] - task.links[index].rest;
        if (joint === 'hinge') {
            hinge.setQuaternion(...product(quaternion, [0, 0, Math.sin(by / 2), Math.cos(by / 2)]));
        } else {
            const [x, y, z, w] = quaternion;  // Z, rotated
            hinge.setPosition(position[0] + by * 2 * (x * z + w * y), position[1] + by * 2 * (y * z - w * x),
                              position[2] + by * (1 - 2 * (x * x + y * y)));
        }
        hinge.setMatrixNeedsUpdate();
    });
}

function measure(settings) {
    const { root, driven, ends } = build();
    const solver = Object.assign(new Solver(root), settings);
    let seconds = 0, gap = 0;
    const a = [0, 0, 0], b = [0, 0, 0];
    for (let turn = 0; turn < 2; ++turn) {  // the first warms up
        seconds = 0;
        for (const values of task.frames) {
            const start = performance.now();
            drive(driven, values);
            solver.solve();
            seconds += performance.now() - start;
            for (const [joint, end] of ends) {
                joint.getWorldPosition(a);
                end.getWorldPosition(b);
                gap = Math.max(gap, Math.hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
            }
        }
    }
    console.log(1000 * seconds / task.frames.length, gap);
}

measure({});
measure({ maxIterations: 200, stallThreshold: 1e-9, translationConvergeThreshold: 1e-6 });
