// The whole library. An engine usually includes only the headers that it calls; each stands on its own.
//
// Units. Metres, kilograms, seconds, radians, hertz. Amounts meant for people (in incidents and findings) have their
// unit beside them. Axes are right-handed with Y up. Chains reach along +X at rest; characters may face any way.
// Quaternions are x, y, z, w in GLM's default memory layout, and wherever they are written out.
//
// Precision. Chains and their solvers are float, accurate within 1e3 m of the origin. Particles of ropes, transforms of
// rigs and characters, and filters are double. Colliders and the shapes that bodies are made from are float: within
// 10 km of the origin they are placed to 1 mm. No coordinate is larger than max_magnitude (magnitude.hpp).
//
// Three kinds of data.
//   Values      joints, poses, every *State, a rope::World. Copy, compare, save and restore them: the next step gives the
//               same bits as the first time, so rollback is a copy and an assignment.
//   Workspaces  rope::Workspace, rig::Workspace, the scratch inside a solver. Make one, keep it; no result depends on it.
//   Parameters  options and settings: plain structs. fields<T>() (fields.hpp) lists their members with names, units,
//               ranges and defaults, for panels, files and scripts.
//
// Ownership. Objects own what they hold and can be moved. Spans and pointers that a call takes are borrowed until it
// returns, also those inside its options: do not store such options. A reference or span that a call returns lives
// until the next change of its object.
//
// Threads. One object, one thread at a time; different objects never share anything. Feet, Hands, LookAt and rig::Rig
// are immutable: many threads may share one. Body, BentChain, SpringChain, Batch and all solvers have scratch memory,
// even where a call is const: one per thread. Large calls spread over threads, yours or their own (tasks.hpp).
//
// Errors. Nothing throws, and everything builds without exceptions and RTTI. A call that may be refused returns a
// Result, or an Expected with the value; the message names the operation, the argument and its value. A solve returns a
// report. A refused call changes nothing. Reading a value that is not there is a bug in the caller and ends the program
// with the message on stderr.
//
// Memory. All of it comes from operator new, so an engine can replace that. Objects allocate when they are made and
// edited. Solver::solve, the step of Feet, Hands, LookAt and SpringChain, and filters and springs allocate nothing
// (except a moving average until its window is full). Neither does World::advance once its workspace has seen the world
// in its present shape.
//
// Bits. The same calls give the same bits with GCC, Clang and MinGW-w64, in debug and release, with every vector unit
// and any number of threads. Exceptions are noted where they occur: ik/many.hpp compared with ik/solver.hpp.
//
// Versions. Until 1.0 a minor version may rename things and change bits; core/CHANGELOG.md says which. Initialisers by
// name, such as {.pole = elbow}, survive new members.
#pragma once

#include "tendril/elementary.hpp"
#include "tendril/humanoid/attach.hpp"
#include "tendril/humanoid/balance.hpp"
#include "tendril/humanoid/bent_chain.hpp"
#include "tendril/humanoid/feet_many.hpp"
#include "tendril/humanoid/footsteps.hpp"
#include "tendril/humanoid/hands.hpp"
#include "tendril/humanoid/hold.hpp"
#include "tendril/humanoid/lint.hpp"
#include "tendril/humanoid/look_at.hpp"
#include "tendril/humanoid/retarget.hpp"
#include "tendril/humanoid/spring_chain.hpp"
#include "tendril/humanoid/twist.hpp"
#include "tendril/ik/incident.hpp"
#include "tendril/ik/many.hpp"
#include "tendril/ik/mechanisms.hpp"
#include "tendril/ik/solver.hpp"
#include "tendril/ik/tree.hpp"
#include "tendril/ik/two_bone.hpp"
#include "tendril/rig/backward.hpp"
#include "tendril/rig/collect.hpp"
#include "tendril/rig/euler.hpp"
#include "tendril/rig/explain.hpp"
#include "tendril/rig/transform_units.hpp"
#include "tendril/rope/edit.hpp"
#include "tendril/rope/hair_roots.hpp"
#include "tendril/rope/quasi_static.hpp"
#include "tendril/signal/batch.hpp"
#include "tendril/signal/measure.hpp"
#include "tendril/version.hpp"
