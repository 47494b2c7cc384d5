// Times Pinocchio.   pinocchio PEER ROBOT.txt...
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/algorithm/regressor.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include "pinocchio_model.hpp"
#include "timing.hpp"

using Vectors = std::vector<Eigen::VectorXd>;

static void time_robot(const char *peer, const RobotData &robot) {
  const pin::Model model = pinocchio_model(robot, 0);
  pin::Data data(model);
  Vectors q, v, a, tau;
  auto eigen = [](const std::vector<double> &x) { return Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(x.data(), Eigen::Index(x.size()))); };
  for (const State &state : robot.states) {
    q.push_back(eigen(state.q));
    v.push_back(eigen(state.qd));
    a.push_back(eigen(state.qdd));
    tau.push_back(eigen(state.tau));
  }
  double largest = 0, worst = 0;
  for (size_t i = 0; i < q.size(); ++i) {
    pin::rnea(model, data, q[i], v[i], a[i]);
    largest = std::max(largest, tau[i].cwiseAbs().maxCoeff());
    worst = std::max(worst, (data.tau - tau[i]).cwiseAbs().maxCoeff());
  }
  const size_t n = q.size();
  auto run = [&](const char *function, auto &&call, double error = -1) {
    report(peer, robot.name, function, nanoseconds(n, [&](size_t i) { call(i); observed(); }), error);
  };
  const pin::FrameIndex tip = model.getFrameId("tip");
  pin::Data::Matrix6x jacobian = pin::Data::Matrix6x::Zero(6, model.nv);
  auto rnea = [&](size_t i) { pin::rnea(model, data, q[i], v[i], a[i]); };
  auto crba = [&](size_t i) { pin::crba(model, data, q[i], pin::Convention::LOCAL); };
  auto aba = [&](size_t i) { pin::aba(model, data, q[i], v[i], tau[i], pin::Convention::LOCAL); };
  auto derivatives = [&](size_t i) { pin::computeRNEADerivatives(model, data, q[i], v[i], a[i]); };
  run("inverse_dynamics", rnea, worst / largest);
  run("mass_matrix", crba);
  run("forward_dynamics", aba);
  run("inverse_dynamics_derivatives", derivatives);
  run("forward_dynamics_derivatives", [&](size_t i) { pin::computeABADerivatives(model, data, q[i], v[i], tau[i]); });
  run("bias", [&](size_t i) { pin::nonLinearEffects(model, data, q[i], v[i]); });
  run("gravity", [&](size_t i) { pin::computeGeneralizedGravity(model, data, q[i]); });
  run("regressor", [&](size_t i) { pin::computeJointTorqueRegressor(model, data, q[i], v[i], a[i]); });
  run("pose_and_jacobian", [&](size_t i) {
    pin::computeJointJacobians(model, data, q[i]);
    pin::updateFramePlacement(model, data, tip);
    pin::getFrameJacobian(model, data, tip, pin::LOCAL_WORLD_ALIGNED, jacobian);
  });
  // Each call waits for a result of the one before, as in a control loop.
  const Vectors given = q;
  auto chained = [&](const char *function, const double *result, auto &&call) {
    run(function, [&](size_t i) { q[i] = given[i].array() + *result * 0.0; call(i); });
  };
  chained("inverse_dynamics latency", data.tau.data(), rnea);
  chained("mass_matrix latency", data.M.data(), crba);
  chained("forward_dynamics latency", data.ddq.data(), aba);
  chained("inverse_dynamics_derivatives latency", data.dtau_dq.data(), derivatives);
}

int main(int count, char **arguments) {
  for (int i = 2; i < count; ++i) time_robot(arguments[1], read_robot(arguments[i]));
}
