// Rigid contacts in place of the scene's law: a friction coefficient, and a restitution for each pair.

import {Unsupported} from './crossgrain_worker.mjs';

/// Restitution of f = k_n δ − γ_n δ̇' between two bodies of that reduced mass [kg]: exp(−β t_c), β = γ_n/(2 m),
/// ω² = k_n/m − β². The contact ends when the bodies part (ω t_c = π) or, where tension is cut, when the force
/// does: Schwager and Pöschel, Granular Matter 9 (2007) 465.
function restitutionOf(law, reducedMass) {
  const beta = law.gn / (2 * reducedMass), squared = law.kn / reducedMass - beta * beta;
  if (!(squared > 0)) throw new Unsupported('has rigid contacts, which stand for no law that is overdamped');
  const omega = Math.sqrt(squared);
  const phase = law.tension === 'cut' ? Math.atan2(2 * beta * omega, beta * beta - squared) : Math.PI;
  return Math.exp(-beta * phase / omega);
}

export class RigidLaw {
  /// @throws Unsupported for laws whose restitution depends on speed
  constructor(law) {
    if (law.normal !== 'rigid' && law.normal !== 'linear')
      throw new Unsupported('has rigid contacts, normal = "rigid"; they can stand for normal = "linear", ' +
                            'whose restitution is the same at every speed');
    if (law.normal === 'linear' && law.gn > 0 && law.damper !== 'constant')
      throw new Unsupported('can stand in for a linear law with damper = "constant" only');
    if (law.normal === 'rigid' && law.et0 !== 0)
      throw new Unsupported('has no tangential restitution, so it needs et0 = 0');
    this.law = law;
    this.soft = law.normal === 'linear';
    this.friction = this.soft && law.tangential === 'none' ? 0 : law.mu;
    this.known = new Map();
  }

  /// @param massI, massJ  [kg]; walls have Infinity
  restitution(massI, massJ) {
    if (!this.soft) return this.law.en;
    const reduced = 1 / (1 / massI + 1 / massJ);
    if (!this.known.has(reduced)) this.known.set(reduced, restitutionOf(this.law, reduced));
    return this.known.get(reduced);
  }

  /// For engines that take the mean of two bodies' restitutions, by mass, with the walls' under Infinity: those of disks are their
  /// own among equals, so that pairs of equals are right; the walls' makes the mean over kinds of disks right.
  restitutionOfEach(masses) {
    const own = new Map(masses.map((mass) => [mass, this.restitution(mass, mass)]));
    const needed = masses.map((mass) => 2 * this.restitution(mass, Infinity) - own.get(mass));
    return own.set(Infinity, needed.reduce((sum, e) => sum + e, 0) / needed.length);
  }

  /// Of `load`: what the law is between disks of the first few masses, and of these with walls.
  /// @param restitution  the engine's, of two masses
  pairs(masses, walls, restitution = (massI, massJ) => this.restitution(massI, massJ), mu = this.friction) {
    const kinds = masses.slice(0, 4), name = (mass) => `${(mass * 1e3).toPrecision(4)} g`;
    const friction = mu > 0 ? {mu} : {};
    return kinds.flatMap((mass, a) => [
      ...kinds.slice(a).map((other) => ({pair: `${name(mass)} with ${name(other)}`, en: restitution(mass, other)})),
      ...(walls ? [{pair: `${name(mass)} with wall`, en: restitution(mass, Infinity)}] : []),
    ]).map((pair) => ({...pair, et0: 0, ...friction}));
  }

  /// Of `load`: where these contacts are other than the scene's.
  deviations(restitutions) {
    const list = [];
    if (this.soft)
      list.push({name: 'normal', value: restitutions[0], unit: '-',
                 note: `rigid contacts with the soft law's e_n, ${restitutions.map((e) => e.toFixed(4)).join(', ')}`});
    if (this.friction > 0 && this.soft)
      list.push({name: 'e_t0', value: 0, unit: '-', note: 'contacts that stick give back nothing of the tangential speed'});
    return list;
  }
}
