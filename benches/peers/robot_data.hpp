// The robots and states that all programs of the comparison use, as written by `calls models`.
#pragma once
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

struct LinkData {
  int parent;      // index of the parent link, -1 for the base
  char kind;       // R, a rotation, or P, a translation
  double axis[3];  // unit vector in the link frame
  double rotation[9], translation[3]; // placement of the joint in the parent's frame, row by row
  double mass, centre[3], inertia[6]; // about the center of mass: xx yy zz xy xz yz
};

struct State {
  std::vector<double> q, qd, qdd, tau; // tau is computed by robot_numeric
};

struct RobotData {
  std::string name;
  double gravity[3];
  std::vector<LinkData> links;
  LinkData tip; // parent and placement of the last frame; the rest is not used
  std::vector<State> states;
};

inline RobotData read_robot(const std::string &path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path);
  auto numbers = [&](double *to, int n) { for (int i = 0; i < n; ++i) in >> to[i]; };
  RobotData robot;
  size_t links = 0, states = 0;
  in >> robot.name;
  numbers(robot.gravity, 3);
  in >> links;
  for (size_t i = 0; i < links; ++i) {
    LinkData link{};
    in >> link.parent >> link.kind;
    numbers(link.axis, 3);
    numbers(link.rotation, 9);
    numbers(link.translation, 3);
    numbers(&link.mass, 1);
    numbers(link.centre, 3);
    numbers(link.inertia, 6);
    robot.links.push_back(link);
  }
  robot.tip = {};
  in >> robot.tip.parent;
  numbers(robot.tip.rotation, 9);
  numbers(robot.tip.translation, 3);
  in >> states;
  for (size_t i = 0; i < states; ++i) {
    State state;
    for (auto *values : {&state.q, &state.qd, &state.qdd, &state.tau}) {
      values->resize(links);
      numbers(values->data(), int(links));
    }
    robot.states.push_back(state);
  }
  if (!in) throw std::runtime_error("cannot understand " + path);
  return robot;
}
