// Pinocchio's model of a robot, with the joint types that its own URDF reader would choose.
#pragma once
#include <pinocchio/multibody.hpp>
#include "robot_data.hpp"

namespace pin = pinocchio;

inline pin::SE3 placement(const LinkData &link, double snap) {
  Eigen::Matrix3d rotation = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(link.rotation);
  for (double &entry : rotation.reshaped())
    for (double exact : {-1.0, 0.0, 1.0})
      if (std::abs(entry - exact) < snap) entry = exact;
  return {rotation, Eigen::Map<const Eigen::Vector3d>(link.translation)};
}

// Entries of rotations closer than `snap` to 0, 1 or -1 are replaced by that number.
inline pin::Model pinocchio_model(const RobotData &robot, double snap) {
  pin::Model model;
  model.gravity.linear() = Eigen::Map<const Eigen::Vector3d>(robot.gravity);
  std::vector<pin::JointIndex> joints;
  auto joint_of = [&](int link) { return link < 0 ? pin::JointIndex(0) : joints[size_t(link)]; };
  for (const LinkData &link : robot.links) {
    Eigen::Vector3d axis = Eigen::Map<const Eigen::Vector3d>(link.axis);
    pin::JointModel joint;
    bool turns = link.kind == 'R';
    if (axis == Eigen::Vector3d::UnitX()) joint = turns ? pin::JointModel(pin::JointModelRX()) : pin::JointModel(pin::JointModelPX());
    else if (axis == Eigen::Vector3d::UnitY()) joint = turns ? pin::JointModel(pin::JointModelRY()) : pin::JointModel(pin::JointModelPY());
    else if (axis == Eigen::Vector3d::UnitZ()) joint = turns ? pin::JointModel(pin::JointModelRZ()) : pin::JointModel(pin::JointModelPZ());
    else joint = turns ? pin::JointModel(pin::JointModelRevoluteUnaligned(axis)) : pin::JointModel(pin::JointModelPrismaticUnaligned(axis));
    std::string name = "joint" + std::to_string(joints.size() + 1);
    joints.push_back(model.addJoint(joint_of(link.parent), joint, placement(link, snap), name));
    const double *i = link.inertia;
    Eigen::Matrix3d inertia;
    inertia << i[0], i[3], i[4], i[3], i[1], i[5], i[4], i[5], i[2];
    pin::Inertia body(link.mass, Eigen::Map<const Eigen::Vector3d>(link.centre), inertia);
    model.appendBodyToJoint(joints.back(), body, pin::SE3::Identity());
  }
  pin::JointIndex carrier = joint_of(robot.tip.parent);
  model.addFrame(pin::Frame("tip", carrier, 0, placement(robot.tip, snap), pin::OP_FRAME));
  return model;
}
