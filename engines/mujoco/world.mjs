// A plane scene as MuJoCo 3's model, stepped as model.cpp steps MuJoCo 2.2: spheres, boxes, capsules and prisms with two slides and a
// hinge, fixed planes, walls that move as bodies of 1e12 masses. README.md has the law; where calls differ between the two versions
// it is said here.

import {readFileSync} from 'node:fs';
import {dot, halfSidesOf, plus, prismOf, scaled} from '../node/crossgrain_vector.mjs';

const home = new URL('../node/node_modules/mujoco-js/', import.meta.url);
const {default: load} = await import(new URL('dist/mujoco_wasm.js', home));
const mujoco = await load({print: console.error, printErr: console.error});
const HEAVY = 1e12, MARGIN = 1e-3;  // as in model.cpp
const WALL = "contype='2' conaffinity='0'";
const FULL = [1, 2];  // mjWARN_CONTACTFULL, mjWARN_CNSTRFULL

export const version = `${mujoco.mj_versionString()} (mujoco-js ${JSON.parse(readFileSync(new URL('package.json', home))).version})`;

/// The power of two next to the smallest of some numbers: units that change no bit.
const unit = (numbers) => (numbers.length ? 2 ** Math.round(Math.log2(Math.min(...numbers))) : 1);

/// Deletes a copy that the binding made after use: it is not garbage-collected.
function once(object, use) {
  const result = use(object);
  object.delete();
  return result;
}

function modelOf(file) {
  try {
    return mujoco.MjModel.loadFromXML(file);
  } catch (error) {  // of the binding's own kind
    throw new Error(`MuJoCo does not take the scene: ${error.message ?? error.name}`);
  }
}

export class MujocoWorld {
  constructor({disks, bodies, law, gravity, dt, rotation, number}) {
    this.length = unit(disks.map((disk) => disk.radius));
    this.mass = unit(disks.map((disk) => disk.mass));
    this.inverse = disks.map((disk) => 1 / disk.mass);
    Object.assign(this, {law: law.law, mu: law.friction, dt, bodies, freedoms: rotation ? 3 : 2, impedance: number('impedance')});
    this.states = bodies.map((body) => body.state(0));
    this.ofWalls = bodies.flatMap((body, b) => body.offset.map((offset) => ({b, offset})));
    mujoco.FS.writeFile('/scene.xml', this.text({disks, gravity, rotation, number}));
    this.model = modelOf('/scene.xml');
    // As in model.cpp: in a plane a contact weighs 1/m, not two thirds of it.
    const weights = this.model.body_invweight0;
    for (let b = 1; b < this.model.nbody; ++b) weights[2 * b] = b <= disks.length ? 1 / this.model.body_mass[b] : 0;
    this.model.stat.meaninertia = 1;
    this.data = new mujoco.MjData(this.model);
    this.force = new mujoco.DoubleBuffer(6);
    this.solved = new mujoco.DoubleBuffer(Math.max(this.model.nv, 1));
    const {qpos, qvel} = this.data, scale = [this.length, this.length, 1];
    disks.forEach(({position, velocity, turn = 0, spin}, i) => {
      for (let k = 0; k < this.freedoms; ++k) {
        qpos[this.freedoms * i + k] = [...position, turn][k] / scale[k];
        qvel[this.freedoms * i + k] = [...velocity, spin][k] / scale[k];
      }
    });
    this.iterations = 0;
    this.pairs = [];
    this.deviations = this.mu > 0 ? [{name: 'dilation', value: this.mu * this.law.gn, unit: 'kg/s',
                                      note: 'growth of f_n with |v_t| where contacts slide'}] : [];
    this.placeMoving();
    this.findForces();
  }

  free() {
    for (const object of [this.solved, this.force, this.data, this.model]) object.delete();
  }

  /// The model's text. Geometries of the world come first in MuJoCo's order, then those of bodies as they are written.
  text({disks, gravity, rotation, number}) {
    const metres = (v) => scaled(1 / this.length, v).join(' '), bodies = this.bodies;
    const ball = (at, radius, more = '') => `<geom type='sphere' size='${radius / this.length}' pos='${metres(at)} 0' ${more}/>`;
    const freely = (mass, inertia, turns, geoms) => `<body><joint type='slide' axis='1 0 0'/><joint type='slide' axis='0 1 0'/>
      ${turns ? "<joint type='hinge' axis='0 0 1'/>" : ''}
      <inertial pos='0 0 0' mass='${mass}' diaginertia='${inertia} ${inertia} ${inertia}'/>${geoms}</body>`;
    const wallBalls = (body, from) => body.offset.map((at, k) => ball(plus(at, from), body.diskRadius[k], WALL)).join('');
    const each = (list, write) => list.map(write).join('');
    const meshes = [];
    const shape = ({kind, vertices, rounding}, reach, i) => {
      const half = halfSidesOf({vertices, rounding});
      if (kind === 'capsule')
        return `<geom type='capsule' size='${rounding / this.length}' fromto='${metres([...vertices[0], 0, ...vertices[1], 0])}'/>`;
      if (half) return `<geom type='box' size='${metres([...half, reach])}'/>`;
      meshes.push(`<mesh name='${i}' vertex='${metres(prismOf(vertices, reach).flat())}'/>`);
      return `<geom type='mesh' mesh='${i}'/>`;
    };
    const geoms = disks.map((disk, i) => (disk.shape ? shape(disk.shape, disk.radius, i) : ball([0, 0], disk.radius)));
    const wallDisks = (moves) => this.ofWalls.flatMap(({b}, k) => (bodies[b].moves === moves ? [disks.length + k] : []));
    const planes = bodies.flatMap((body) => body.planes);
    const firstPlane = disks.length + this.ofWalls.length;
    this.ids = [...wallDisks(false), ...planes.map((_, p) => firstPlane + p), ...disks.keys(), ...wallDisks(true)];
    this.firstOf = [];
    let freedom = this.freedoms * disks.length;
    for (const {moves} of bodies) {
      this.firstOf.push(moves ? freedom : -1);
      freedom += moves ? 3 : 0;
    }
    return `<mujoco><compiler angle='radian' inertiafromgeom='false'/>
      <option timestep='${this.dt}' gravity='${metres(gravity)} 0' integrator='Euler' cone='elliptic' jacobian='sparse'
        solver='${number('solver')}' iterations='${number('iterations')}' tolerance='${number('tolerance')}'
        impratio='${this.mu > 0 ? this.law.gt / this.law.gn : 1}'/>
      <default><geom condim='${this.mu > 0 ? 3 : 1}' contype='1' conaffinity='3' margin='${MARGIN}' gap='${MARGIN}'/></default>
      <asset>${meshes.join('')}</asset><worldbody>
      ${each(bodies, (body) => (body.moves ? '' : wallBalls(body, body.start)))}
      ${each(planes, ({point, normal}) => `<geom type='plane' size='1 1 1' pos='${metres(point)} 0' zaxis='${normal.join(' ')} 0' ${WALL}/>`)}
      ${each(disks, ({mass, inertia}, i) => freely(mass / this.mass, inertia / (this.mass * this.length ** 2), rotation, geoms[i]))}
      ${each(bodies, (body) => (body.moves ? freely(HEAVY, HEAVY ** 2, true, wallBalls(body, [0, 0])) : ''))}
      </worldbody></mujoco>`;
  }

  placeWalls(_, next) { this.states = next; }

  placeMoving() {
    const {qpos, qvel} = this.data;
    this.states.forEach(({centre, velocity, angle, spin}, b) => {
      const at = this.firstOf[b];
      if (at < 0) return;
      qpos.set([...scaled(1 / this.length, centre), angle], at);
      qvel.set([...scaled(1 / this.length, velocity), spin], at);
    });
  }

  step() {
    mujoco.mj_Euler(this.model, this.data);
    this.placeMoving();
    this.findForces();
  }

  run(...stages) {
    for (const stage of stages) mujoco[stage](this.model, this.data);
  }

  /// The work of mj_forward, but for constants of each contact. MuJoCo 3 has its mass matrix from mj_makeM.
  findForces() {
    this.run('mj_kinematics', 'mj_comPos', 'mj_crb', 'mj_makeM', 'mj_factorM', 'mj_collision');
    this.setContacts();
    this.run('mj_makeConstraint', 'mj_projectConstraint', 'mj_fwdVelocity', 'mj_fwdActuation', 'mj_fwdAcceleration', 'mj_fwdConstraint');
    const {data} = this;
    if (this.impedance < 0.5 && this.model.nv > 0) {  // what the solver leaves: model.cpp
      mujoco.mj_solveM(this.model, data, this.solved, [...data.qfrc_constraint]);
      const {qacc, qacc_smooth: smooth} = data;  // views that the call may leave without memory
      this.solved.GetView().forEach((a, k) => { qacc[k] = a + smooth[k]; });
    }
    this.iterations += data.solver_niter[0];
    const warnings = data.warning;
    const full = FULL.some((kind) => once(warnings.get(kind), ({number}) => number > 0));
    warnings.delete();
    if (full) throw new Error(`MuJoCo has no room for more contacts: ${data.ncon}`);
  }

  /// solref = (−k_n/m₁₂, −γ_n/m₁₂). The binding shows copies of contacts: they are put back one by one.
  setContacts() {
    const {data, law} = this, found = data.contact;
    this.contacts = [];
    data.ncon = 0;
    for (let c = 0; c < found.size(); ++c) {
      const contact = found.get(c), a = this.ids[contact.geom1], b = this.ids[contact.geom2];
      const inverse = (this.inverse[a] ?? 0) + (this.inverse[b] ?? 0);
      contact.solref.set([-law.kn * inverse, -law.gn * inverse]);
      contact.solimp.fill(this.impedance, 0, 2);
      if (this.mu > 0) contact.friction.fill(this.mu, 0, 2);
      mujoco.mj_addContact(this.model, data, contact);
      const point = scaled(this.length, [...contact.pos].slice(0, 2)), depth = -contact.dist * this.length;
      this.contacts.push({a, b, acts: contact.exclude === 0, frame: [...contact.frame], point, depth});
      contact.delete();
    }
    found.delete();
  }

  touching() { return this.contacts.filter(({acts}) => acts).length; }

  /// Forces of now, times the step. The frame's rows are the normal from the first geometry to the second and two tangents; the force
  /// acts on the second.
  impulses(visit) {
    const newton = this.mass * this.length * this.dt;
    this.contacts.forEach(({a, b, acts, frame, point, depth}, c) => {
      if (!acts) return;
      mujoco.mj_contactForce(this.model, this.data, c, this.force);
      const force = this.force.GetView(), sense = (a < b ? -1 : 1);
      const normal = [sense * frame[0], sense * frame[1]];
      const onFirst = [0, 1].map((k) => sense * newton * (force[0] * frame[k] + force[1] * frame[3 + k] + force[2] * frame[6 + k]));
      visit(Math.min(a, b), Math.max(a, b), dot(onFirst, normal), dot(onFirst, [-normal[1], normal[0]]),
            () => ({normal, point: this.placeOf(Math.max(a, b), point), depth}));
    });
  }

  /// Where a force acts; without rotation on wall disks' centres.
  placeOf(j, point) {
    const wall = this.freedoms === 2 && this.ofWalls[j - this.inverse.length];
    return wall ? this.bodies[wall.b].placed(wall.offset, this.states[wall.b]) : point;
  }

  disk(i) {
    const {qpos, qvel} = this.data, at = this.freedoms * i, turns = this.freedoms === 3;
    return {
      position: [qpos[at] * this.length, qpos[at + 1] * this.length],
      velocity: [qvel[at] * this.length, qvel[at + 1] * this.length],
      turn: turns ? qpos[at + 2] : 0,
      spin: turns ? qvel[at + 2] : 0,
    };
  }
}
