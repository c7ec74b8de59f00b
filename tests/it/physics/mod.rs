//! Vehicles under physics: against published trajectories, single effects, contacts, waves.

mod autopilot;
mod hulls;
mod kinematic;
mod kit;
mod rapier_alone;
mod sea;
mod vehicle;
mod vehicle_contacts;
mod vehicle_effects;
mod vehicle_published;
