// Hollow cylinders for engines that have solid ones alone: for each sphere and cylinder a ball of the sphere's size, outside of the
// wall. Before each step it is put where it touches the wall at the point nearest to the sphere, and gets the wall's velocity there.
// The sphere, s from the axis, meets it with n to the axis and δ = a + b − (R + b − s) = a − (R − s). The ball is behind the plane that
// touches the wall there, and the whole inside is before that: no other sphere comes to it.

import {facing} from './crossgrain_walls.mjs';

/// Cylinder by cylinder, in the order of their ids, one for each sphere.
export const ballsOf = (bodies, spheres) =>
  bodies.flatMap((body, b) =>
    body.cylinders.flatMap((cylinder) => spheres.map(({radius}, sphere) => ({body, b, cylinder, sphere, radius, follows: true}))));

/// Before a step. Balls of spheres that are far from the wall rest where they were left, outside.
/// @param positionOf  of a sphere by its number  @param states  of the bodies
/// @param place       (ball, its number, centre, velocity)
export function placeBalls(balls, positionOf, states, place) {
  balls.forEach((ball, k) => {
    const {body, b, cylinder, sphere, radius, follows} = ball;
    const from = positionOf(sphere), {normal, distance} = facing(cylinder, from), behind = (by) => from.map((x, c) => x - by * normal[c]);
    ball.follows = distance < 2 * radius;
    if (ball.follows) place(ball, k, behind(distance + radius), body.velocityAt(behind(distance), states[b]));
    else if (follows) place(ball, k, behind(distance + radius), [0, 0, 0]);
  });
}
