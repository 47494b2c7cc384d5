//! The conventions that every generated module states.

/// The conventions of robot files, equations and code; each entry is a line.
pub const CONVENTIONS: [&str; 7] = [
    "SI units, angles in radians; right-handed frames. A link frame is the parent frame, \
     displaced as given in the robot file and then moved by the joint.",
    "Roll, pitch and yaw are rotations about fixed axes: R = Rz(yaw) Ry(pitch) Rx(roll).",
    "The gravity vector is the acceleration of gravity: it points down.",
    "Inertia tensors are about the center of mass, in link axes unless the file says otherwise.",
    "A tip's wrench is the wrench that the tip exerts on its surroundings, in the tip's axes, \
     with the moment about the tip's origin; the external wrench, which acts on the tip, is its \
     negative. If the tip's z axis points up, a mass m that hangs at rest from the tip's origin has the \
     wrench with the force z = +m g.",
    "Armature, rotor inertia and gear ratio are separate values; the reflected inertia is \
     armature + ratio² · rotor inertia.",
    "Friction is the sum of the terms that the joint has: b q̇, an offset, dry friction times \
     sgn q̇ (with a smoothing v, tanh(q̇/v)). Dry friction is constant, with one value or one for each \
     direction, or it is c (d/2) F for a revolute joint and c F for a prismatic joint, where \
     F is the magnitude of the contact force perpendicular to the axis; sgn 0 = 0.",
];
