#include "oracle/convex_impact.hpp"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace crossgrain::inline oracle {

namespace {

/// Share of a velocity or an impulse that is taken for 0.
constexpr double rounding = 1e-14;
constexpr double never = std::numeric_limits<double>::infinity();

/// Adds an impulse at the contact [N s].
template <int D>
void push(ConvexImpactBody<D>& body, const VecOf<D>& impulse) {
  body.velocity += impulse / body.mass;
  if constexpr (D == 2)
    body.spin += body.inverseInertia * cross(body.arm, impulse);
  else
    body.spin += body.inverseInertia * body.arm.cross(impulse);
}

}  // namespace

template <int D>
double kineticEnergy(const ConvexImpactBody<D>& body) {
  double twice = std::isfinite(body.mass) ? body.mass * body.velocity.squaredNorm() : 0.0;
  if constexpr (D == 2) {
    if (body.inverseInertia > 0.0) twice += body.spin * body.spin / body.inverseInertia;
  } else {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(body.inverseInertia);
    for (const int axis : {0, 1, 2}) {
      const double inverse = axes.eigenvalues()[axis];
      if (!(inverse > 1e-14 * axes.eigenvalues()[2])) continue;  // cannot turn about it
      const double about = axes.eigenvectors().col(axis).dot(body.spin);
      twice += about * about / inverse;
    }
  }
  return 0.5 * twice;
}
template double kineticEnergy(const ConvexImpactBody<2>&);
template double kineticEnergy(const ConvexImpactBody<3>&);

namespace {

/// Columns n, then the tangents.
template <int D>
Eigen::Matrix<double, D, D> contactFrame(const VecOf<D>& n) {
  Eigen::Matrix<double, D, D> frame;
  if constexpr (D == 2) {
    frame << n, perpendicular(n);
  } else {
    const Vec3 s = n.unitOrthogonal();
    frame << n, s, n.cross(s);
  }
  return frame;
}

/// Routh's method in units in which |u| = 1 at the start and B = 1.
template <int D>
class Hodograph {
 public:
  using Tangent = VecOf<D - 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  /// State of the contact.
  struct Moment {
    VecOf<D> u = VecOf<D>::Zero();        ///< n first
    VecOf<D> impulse = VecOf<D>::Zero();  ///< P, with p first
    double work = 0.0;                    ///< ∫ u_n dp
  };
  enum class Goal { noApproach, impulse, work };
  struct Aim {
    Goal goal;
    double value = 0.0;  ///< of p or ∫ u_n dp
  };

  Hodograph(const Matrix& m, double mu, const VecOf<D>& u)
      : normal_(m(0, 0)),
        coupling_(m.template bottomLeftCorner<D - 1, 1>()),
        tangential_(m.template bottomRightCorner<D - 1, D - 1>()),
        mu_(mu) {
    now.u = u;
    if (slip().isZero(0.0)) settle(ImpactKind::stick, ImpactKind::slip);
  }

  /// Goes on to an aim.
  void advance(const Aim& aim) {
    if (slides_) {
      if (slide(aim)) return;
      now.u.template tail<D - 1>().setZero();
      settle(ImpactKind::slipThenStick, ImpactKind::slipThenReversed);
    }
    go(rate_, distance(rate_, aim));
  }

  /// The direction of a slip that begins.
  Tangent begins() const {
    if (coupling_.isZero(0.0)) return coupling_;
    // |v| = 1 of v = (λ + µA)⁻¹C: Newton's method on 1/|v|, which rises and is concave, from below.
    double lambda = std::max(0.0, coupling_.norm() - mu_ * tangential_.norm());
    Tangent direction;
    for (int i = 0; i < 100; ++i) {
      const auto matrix =
          (lambda * TangentMatrix::Identity() + mu_ * tangential_).eval().inverse().eval();
      direction = matrix * coupling_;
      const double size = direction.norm();
      const double more = (size - 1.0) * size * size / direction.dot(matrix * direction);
      if (!(more > 1e-16 * lambda)) break;
      lambda += more;
    }
    return direction.normalized();
  }

  Moment now;
  ImpactKind kind = ImpactKind::slip;

 private:
  using TangentMatrix = Eigen::Matrix<double, D - 1, D - 1>;

  Tangent slip() const { return now.u.template tail<D - 1>(); }

  /// du/dp under dP_t/dp.
  VecOf<D> change(const Tangent& rate) const {
    VecOf<D> to;
    to << normal_ + coupling_.dot(rate), coupling_ + tangential_ * rate;
    return to;
  }

  /// From no slip: dP_t/dp for the rest of the impact, and its kind if it sticks or not.
  void settle(ImpactKind sticks, ImpactKind slips) {
    slides_ = false;
    rate_ = -tangential_.inverse() * coupling_;
    kind = rate_.norm() <= mu_ + rounding ? sticks : slips;
    if (kind == slips) rate_ = -mu_ * begins();
  }

  /// p up to an aim under a constant rate.
  double distance(const Tangent& rate, const Aim& aim) const {
    const double un = now.u[0], rise = change(rate)[0];
    switch (aim.goal) {
      case Goal::noApproach:
        return un >= 0.0 ? 0.0 : rise > 0.0 ? -un / rise : never;
      case Goal::impulse:
        return aim.value - now.impulse[0];
      case Goal::work:
        break;
    }
    const double left = std::max(aim.value - now.work, 0.0), square = un * un + 2.0 * rise * left;
    if (left == 0.0) return 0.0;
    return square < 0.0 || !(un + std::sqrt(square) > 0.0) ? never
                                                           : 2.0 * left / (un + std::sqrt(square));
  }

  void go(const Tangent& rate, double p) {
    const VecOf<D> du = p * change(rate);
    now.work += p * (now.u[0] + 0.5 * du[0]);
    now.u += du;
    now.impulse[0] += p;
    now.impulse.template tail<D - 1>() += p * rate;
  }

  /// Goes on while it slips. @returns whether it reaches the aim before it stops
  bool slide(const Aim& aim) {
    const Tangent direction = slip().normalized(), rate = -mu_ * direction;
    const Tangent change = this->change(rate).template tail<D - 1>();
    const double along = direction.dot(change);
    if constexpr (D == 3)
      if (mu_ > 0.0 && (change - along * direction).norm() > straight()) return turn(aim);
    const double reaches = distance(rate, aim);
    // Without friction a slip that turns neither stops nor matters.
    const bool stops = along < 0.0 && (change - along * direction).norm() <= straight();
    const double until = stops ? slip().norm() / -along : never;
    go(rate, std::min(reaches, until));
    return reaches <= until;
  }

  /// |du_t/dp| across the slip that is rounding.
  double straight() const { return rounding * (coupling_.norm() + mu_ * tangential_.norm()); }

  /// Slip that turns, in space. Integrates ln |u_t|, the angle of its direction, p and ∫ u_n dp by
  /// τ with dp = |u_t| dτ: the right-hand side stays smooth where the slip falls to 0, which takes
  /// endless τ. Once the slip no longer turns the rest is exact.
  bool turn(const Aim& aim) requires(D == 3) {
    using Variables = std::array<double, 4>;
    from_ = now;
    gsl_odeiv2_system system{&Hodograph::derivative, nullptr, 4, this};
    const std::unique_ptr<gsl_odeiv2_step, decltype(&gsl_odeiv2_step_free)> stepper(
        gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk8pd, 4), &gsl_odeiv2_step_free);
    const std::unique_ptr<gsl_odeiv2_control, decltype(&gsl_odeiv2_control_free)> control(
        gsl_odeiv2_control_y_new(1e-14, 1e-14), &gsl_odeiv2_control_free);
    const std::unique_ptr<gsl_odeiv2_evolve, decltype(&gsl_odeiv2_evolve_free)> evolve(
        gsl_odeiv2_evolve_alloc(4), &gsl_odeiv2_evolve_free);

    Variables y{std::log(slip().norm()), std::atan2(now.u[2], now.u[1]), now.impulse[0], now.work};
    double time = 0.0, step = 0.01;
    const auto beyond = [&aim](const Moment& at) {
      return aim.goal == Goal::noApproach ? at.u[0]
             : aim.goal == Goal::impulse  ? at.impulse[0] - aim.value
                                          : at.work - aim.value;
    };
    if (beyond(now) >= 0.0) return true;
    for (int count = 0; count < 100'000; ++count) {
      const Variables before = y;
      const double since = time;
      if (gsl_odeiv2_evolve_apply(evolve.get(), control.get(), stepper.get(), &system, &time, 1e300,
                                  &step, y.data()) != GSL_SUCCESS)
        break;
      if (beyond(momentOf(y)) >= 0.0) {
        double least = 0.0, most = time - since;
        const auto after = [&](double h) {
          Variables to = before, error;
          gsl_odeiv2_step_reset(stepper.get());
          gsl_odeiv2_step_apply(stepper.get(), since, h, to.data(), error.data(), nullptr, nullptr,
                                &system);
          return momentOf(to);
        };
        for (double h; h = 0.5 * (least + most), least < h && h < most;)
          (beyond(after(h)) >= 0.0 ? most : least) = h;
        now = after(most);
        return true;
      }
      now = momentOf(y);
      if (y[0] < std::log(1e-15)) return false;
      const Vec2 direction(std::cos(y[1]), std::sin(y[1])), side(-direction.y(), direction.x());
      if (std::abs(side.dot(change(-mu_ * direction).template tail<2>())) <= straight())
        return slide(aim);
    }
    throw std::runtime_error("the hodograph of an impact cannot be integrated");
  }

  /// Right-hand side of turn().
  static int derivative(double, const double* y, double* dy, void* of) {
    const Hodograph& self = *static_cast<const Hodograph*>(of);
    const Vec2 direction(std::cos(y[1]), std::sin(y[1]));
    const Vec2 change = self.coupling_ - self.mu_ * self.tangential_ * direction;
    const double speed = std::exp(y[0]);
    dy[0] = direction.dot(change);
    dy[1] = cross(direction, change);
    dy[2] = speed;
    dy[3] = speed * self.momentOf(y).u[0];
    return GSL_SUCCESS;
  }

  template <typename Variables>
  Moment momentOf(const Variables& y) const {
    Moment at = from_;
    const double p = y[2] - from_.impulse[0];
    at.u.template tail<2>() = std::exp(y[0]) * Vec2(std::cos(y[1]), std::sin(y[1]));
    const Vec2 tangential =
        tangential_.inverse() * ((at.u - from_.u).template tail<2>() - p * coupling_);
    at.u[0] += normal_ * p + coupling_.dot(tangential);
    at.impulse += (Vec3() << p, tangential).finished();
    at.work = y[3];
    return at;
  }

  double normal_;             // B
  Tangent coupling_;          // C
  TangentMatrix tangential_;  // A
  double mu_;
  bool slides_ = true;              // not settled yet
  Tangent rate_ = Tangent::Zero();  // dP_t/dp once settled
  Moment from_;                     // at which turn() began
};

/// Newton's impulse, in the units of Hodograph, n first.
template <int D>
std::optional<VecOf<D>> newtonsImpulse(const Eigen::Matrix<double, D, D>& m, const VecOf<D>& u,
                                       double mu, double e, const VecOf<D - 1>& direction,
                                       ImpactKind& kind) {
  VecOf<D> change = -u;
  change[0] *= 1.0 + e;
  VecOf<D> impulse = m.ldlt().solve(change);
  kind = ImpactKind::stick;
  if (impulse.template tail<D - 1>().norm() <= (mu + rounding) * impulse[0]) return impulse;
  kind = ImpactKind::slip;
  impulse << 1.0, -mu * direction;
  const double rise = m.row(0).dot(impulse);
  if (!(rise > 0.0)) return std::nullopt;
  return -(1.0 + e) * u[0] / rise * impulse;
}

template <int D>
void validate(const ConvexImpactStart<D>& start) {
  if (!(std::abs(start.normal.norm() - 1.0) < 1e-9))
    throw std::invalid_argument("the normal of an impact has no length of 1");
  if (!(start.restitution >= 0.0 && start.restitution <= 1.0))
    throw std::invalid_argument("the restitution of an impact is not in [0, 1]");
  if (!(start.mu >= 0.0 && std::isfinite(start.mu)))
    throw std::invalid_argument("the friction of an impact is not in [0, ∞)");
  for (const auto& body : start.body)
    if (!(body.mass > 0.0)) throw std::invalid_argument("a mass in an impact is not above 0");
  if (std::isinf(start.body[0].mass) && std::isinf(start.body[1].mass))
    throw std::invalid_argument("an impact has no body that moves");
}

}  // namespace

template <int D>
ConvexImpact<D> convexImpact(const ConvexImpactStart<D>& start) {
  validate(start);
  const Eigen::Matrix<double, D, D> frame = contactFrame<D>(start.normal);
  const double mu = start.mu, e = start.restitution;
  VecOf<D> u = VecOf<D>::Zero();
  Eigen::Matrix<double, D, D> m = Eigen::Matrix<double, D, D>::Zero();
  double energyBefore = 0.0, still = 0.0;
  for (const int side : {0, 1}) {
    const ConvexImpactBody<D>& body = start.body[side];
    const VecOf<D> velocity = frame.transpose() * velocityAtContact(body);
    u += side == 0 ? velocity : -velocity;
    still += rounding * (body.velocity.norm() + (velocityAtContact(body) - body.velocity).norm());
    energyBefore += kineticEnergy(body);
    for (int axis = 0; axis < D; ++axis) {
      ConvexImpactBody<D> pushed{body.mass, body.inverseInertia, body.arm};
      push<D>(pushed, frame.col(axis));
      m.col(axis) += frame.transpose() * velocityAtContact(pushed);
    }
  }
  if (u.template tail<D - 1>().norm() <= still) u.template tail<D - 1>().setZero();

  const auto outcome = [&](const VecOf<D>& local, ImpactKind kind) {
    ImpactOutcome<D> to;
    to.kind = kind;
    to.impulse = frame * local;
    to.gain = local.dot(u + 0.5 * (m * local));
    to.energyAfter = 0.0;
    for (const int side : {0, 1}) {
      ConvexImpactBody<D> body = start.body[side];
      push<D>(body, side == 0 ? to.impulse : -to.impulse);
      to.velocity[side] = body.velocity;
      to.spin[side] = body.spin;
      to.energyAfter += kineticEnergy(body);
    }
    return to;
  };
  if (u[0] >= 0.0) {
    const auto nothing = outcome(VecOf<D>::Zero(), ImpactKind::separating);
    return {energyBefore, nothing, nothing, nothing, 0.0, true};
  }

  const double speed = u.norm(), unit = speed / m(0, 0);
  const Eigen::Matrix<double, D, D> scaled = m / m(0, 0);
  const VecOf<D> scaledU = u / speed;
  Hodograph<D> compression(scaled, mu, scaledU);
  VecOf<D - 1> direction = scaledU.template tail<D - 1>();
  direction = direction.isZero(0.0) ? compression.begins() : direction.normalized().eval();
  using Path = Hodograph<D>;
  compression.advance({Path::Goal::noApproach});
  const auto ended = [&](const typename Path::Aim& aim) {
    Path restitution = compression;
    restitution.advance(aim);
    return outcome(unit * restitution.now.impulse, restitution.kind);
  };
  ImpactKind kind;
  const auto newton = newtonsImpulse<D>(scaled, scaledU, mu, e, direction, kind);
  ConvexImpact<D> all{energyBefore,
                      std::nullopt,
                      ended({Path::Goal::impulse, (1.0 + e) * compression.now.impulse[0]}),
                      ended({Path::Goal::work, (1.0 - e * e) * compression.now.work}),
                      never,
                      false};
  if (newton) {
    all.newton = outcome(unit * *newton, kind);
    const VecOf<D>&a = all.newton->impulse, &b = all.poisson.impulse, &c = all.stronge.impulse;
    all.spread = std::max({(a - b).norm(), (b - c).norm(), (c - a).norm()}) /
                 std::max({a.norm(), b.norm(), c.norm()});
  }
  all.judged = all.spread <= ConvexImpact<D>::agreement;
  return all;
}

template ConvexImpact<2> convexImpact(const ConvexImpactStart<2>&);
template ConvexImpact<3> convexImpact(const ConvexImpactStart<3>&);

template <int D>
CornerOf<D> cornerTowards(const ShapeOf<D>& shape, const TurnOf<D>& turn,
                          const VecOf<D>& direction) {
  const Eigen::Matrix<double, D, D> axes = matrixOf<D>(turn);
  const VecOf<D> own = axes.transpose() * direction;
  std::vector<double> behind;
  for (const VecOf<D>& corner : shape.vertices) behind.push_back(-corner.dot(own));
  std::ranges::sort(behind);
  double next = behind[1] - behind[0];
  // The other side of a cylinder's rim.
  if (shape.kind == ShapeKind::cylinder)
    next = std::min(next, 2.0 * shape.rounding * own.template head<D - 1>().norm());
  return {axes * farthest<D>(shape, own), next};
}

template <int D>
ConvexImpactBody<D> impactBody(const DisksOf<D>& bodies, std::size_t i, const VecOf<D>& arm) {
  ConvexImpactBody<D> body{bodies.mass[i], {}, arm, bodies.velocity[i], bodies.spin[i]};
  if constexpr (D == 2) {
    body.inverseInertia = 1.0 / bodies.inertia[i];
  } else {
    const Eigen::Matrix3d axes = matrixOf<3>(bodies.turn[i]);
    body.inverseInertia = axes * bodies.moments[i].cwiseInverse().asDiagonal() * axes.transpose();
  }
  return body;
}

template <int D>
CollisionEnd convexEnd(const ConvexImpactStart<D>& start, const std::array<VecOf<D>, 2>& velocity,
                       const std::array<SpinOf<D>, 2>& spin) {
  const auto between = [](const ConvexImpactStart<D>& at) -> VecOf<D> {
    return velocityAtContact(at.body[0]) - velocityAtContact(at.body[1]);
  };
  const auto ofCentres = [](const ConvexImpactStart<D>& at) -> VecOf<D> {
    return at.body[0].velocity - at.body[1].velocity;
  };
  ConvexImpactStart<D> after = start;
  CollisionEnd end;
  for (const int side : {0, 1}) {
    after.body[side].velocity = velocity[side];
    after.body[side].spin = spin[side];
    end.energyBefore += kineticEnergy(start.body[side]);
    end.energyAfter += kineticEnergy(after.body[side]);
  }
  const VecOf<D> before = between(start), parting = between(after), centres = ofCentres(after);
  const double speed = -before[0], along = ofCentres(start)[1];
  const auto isZero = [&](double part) { return std::abs(part) < 1e-12 * speed; };
  end.en = parting[0] / speed;
  end.psi = parting[1] / speed;
  if (!isZero(before[1])) end.beta = -parting[1] / before[1];
  end.centrePsi = centres[1] / speed;
  if (!isZero(along)) end.et = centres[1] / along;
  end.reboundAngle = std::atan2(centres[1], centres[0]);
  if constexpr (D == 3) {
    EndOutOfPlane& besides = end.outOfPlane.emplace();
    besides.psi = parting[2] / speed;
    for (const int side : {0, 1}) {
      besides.spinNormal[side] = spin[side].x();
      besides.spinTangent[side] = spin[side].y();
      end.spin[side] = spin[side].z();
    }
  } else {
    for (const int side : {0, 1}) end.spin[side] = spin[side];
  }
  end.convex = {centres[0] / speed, std::max(0.0, end.energyAfter - end.energyBefore)};
  return end;
}

template CornerOf<2> cornerTowards(const ShapeOf<2>&, const TurnOf<2>&, const Vec2&);
template CornerOf<3> cornerTowards(const ShapeOf<3>&, const TurnOf<3>&, const Vec3&);
template ConvexImpactBody<2> impactBody(const DisksOf<2>&, std::size_t, const Vec2&);
template ConvexImpactBody<3> impactBody(const DisksOf<3>&, std::size_t, const Vec3&);
template CollisionEnd convexEnd(const ConvexImpactStart<2>&, const std::array<Vec2, 2>&,
                                const std::array<double, 2>&);
template CollisionEnd convexEnd(const ConvexImpactStart<3>&, const std::array<Vec3, 2>&,
                                const std::array<Vec3, 2>&);

}  // namespace crossgrain::inline oracle
