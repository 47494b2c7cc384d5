// Writes the C code that CasADi generates from Pinocchio's algorithms: they run on casadi::SX, and common
// subexpressions are shared (casadi::cse).
//
//   casadi_source FOLDER ROBOT.txt...
//
// Also saves the function of inverse dynamics itself as FOLDER/ROBOT_inverse_dynamics.casadi.
//
// The wheels do not contain pinocchio.casadi for Python; this program does the same without Python. Rotations
// within 1e-4 of exact ones are made exact, which yields the fastest code with CasADi.
#include <pinocchio/autodiff/casadi.hpp>
#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/aba-derivatives.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/algorithm/regressor.hpp>
#include <pinocchio/algorithm/rnea.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <cstdio>
#include "pinocchio_model.hpp"

using casadi::SX;
using Model = pin::ModelTpl<SX>;
using Data = pin::DataTpl<SX>;
using Vector = Eigen::Matrix<SX, Eigen::Dynamic, 1>;

template <class Matrix> static SX dense(const Matrix &matrix) {
  SX result = SX::zeros(matrix.rows(), matrix.cols());
  for (int i = 0; i < matrix.rows(); ++i)
    for (int j = 0; j < matrix.cols(); ++j) result(i, j) = SX(matrix(i, j));
  return result;
}

static Vector vector(const SX &symbols) {
  Vector result(symbols.size1());
  for (int i = 0; i < result.size(); ++i) result[i] = symbols(i);
  return result;
}

static void write_source(const std::string &folder, const RobotData &robot) {
  const Model model = pinocchio_model(robot, 1e-4).cast<SX>();
  const pin::FrameIndex tip = model.getFrameId("tip");
  SX sq = SX::sym("q", model.nv), sv = SX::sym("v", model.nv), sa = SX::sym("a", model.nv), st = SX::sym("t", model.nv);
  Vector q = vector(sq), v = vector(sv), a = vector(sa), tau = vector(st);
  std::vector<casadi::Function> functions;
  auto add = [&](const char *name, std::vector<SX> in, std::vector<SX> out) {
    functions.emplace_back(name, in, cse(out));
    int operations = 0;
    for (int i = 0; i < functions.back().n_instructions(); ++i) {
      auto code = functions.back().instruction_id(i);
      bool counts = false;
      for (auto op : {casadi::OP_ADD, casadi::OP_SUB, casadi::OP_MUL, casadi::OP_DIV, casadi::OP_SQ, casadi::OP_TWICE, casadi::OP_INV})
        counts = counts || code == op;
      operations += counts;
    }
    std::printf("{\"peer\": \"casadi\", \"robot\": \"%s\", \"function\": \"%s\", \"operations\": %d}\n", robot.name.c_str(), name, operations);
  };
  { Data data(model); pin::rnea(model, data, q, v, a); add("inverse_dynamics", {sq, sv, sa}, {dense(data.tau)}); }
  { Data data(model); pin::nonLinearEffects(model, data, q, v); add("bias", {sq, sv}, {dense(data.nle)}); }
  { Data data(model); pin::computeGeneralizedGravity(model, data, q); add("gravity", {sq}, {dense(data.g)}); }
  {
    Data data(model);
    pin::crba(model, data, q, pin::Convention::LOCAL);
    for (int i = 0; i < model.nv; ++i)
      for (int j = 0; j < i; ++j) data.M(i, j) = data.M(j, i);
    add("mass_matrix", {sq}, {dense(data.M)});
  }
  { Data data(model); pin::aba(model, data, q, v, tau, pin::Convention::LOCAL); add("forward_dynamics", {sq, sv, st}, {dense(data.ddq)}); }
  {
    Data data(model);
    pin::computeRNEADerivatives(model, data, q, v, a);
    add("inverse_dynamics_derivatives", {sq, sv, sa}, {dense(data.dtau_dq), dense(data.dtau_dv)});
  }
  {
    Data data(model);
    pin::computeABADerivatives(model, data, q, v, tau);
    add("forward_dynamics_derivatives", {sq, sv, st}, {dense(data.ddq_dq), dense(data.ddq_dv), dense(data.Minv)});
  }
  {
    Data data(model);
    pin::computeJointTorqueRegressor(model, data, q, v, a);
    add("regressor", {sq, sv, sa}, {dense(data.jointTorqueRegressor)});
  }
  {
    Data data(model);
    Data::Matrix6x jacobian(6, model.nv);
    jacobian.setZero();
    pin::computeJointJacobians(model, data, q);
    pin::updateFramePlacement(model, data, tip);
    pin::getFrameJacobian(model, data, tip, pin::LOCAL_WORLD_ALIGNED, jacobian);
    add("pose_and_jacobian", {sq}, {dense(data.oMf[tip].rotation()), dense(data.oMf[tip].translation()), dense(jacobian)});
  }
  casadi::CodeGenerator generator(robot.name + ".c");
  for (const auto &function : functions) generator.add(function);
  generator.generate(folder + "/");
  functions.front().save(folder + "/" + robot.name + "_inverse_dynamics.casadi");
}

int main(int count, char **arguments) {
  for (int i = 2; i < count; ++i) write_source(arguments[1], read_robot(arguments[i]));
}
