//! What a gantry ran into: which slide, what it touched, where and how hard.

use super::body::ContactReport;
use super::gantry_body::{GantryContact, GantryId, Solid};
use super::solid::Physics;
use crate::convert::from_vector;
use rapier3d::prelude as r;

impl Physics {
    /// Combines the contacts of a gantry's two slides.
    pub(super) fn gantry_touch(&self, gantry: usize, touched: &[ContactReport; 2]) -> GantryContact {
        let mut contact = GantryContact {
            impulse_N_s: touched.map(|t| t.impulse_N_s),
            max_penetration_m: touched[0].max_penetration_m.max(touched[1].max_penetration_m),
            ..GantryContact::default()
        };
        if !touched.iter().any(|t| t.touching) {
            return contact;
        }
        let mut hardest = 0.0;
        for slide in self.gantries[gantry].slides {
            for &collider in self.world.bodies[slide].colliders() {
                for pair in self.world.contact_pairs_with(collider) {
                    let impulse = pair.total_impulse_magnitude();
                    if impulse > hardest {
                        hardest = impulse;
                        let other = if pair.collider1 == collider { pair.collider2 } else { pair.collider1 };
                        contact.with = self.solid(other);
                        contact.at_W = self.touch_point(pair);
                    }
                }
            }
        }
        contact
    }

    fn solid(&self, collider: r::ColliderHandle) -> Option<Solid> {
        let Some(parent) = self.world.colliders[collider].parent() else {
            let fixed = self.fixed.iter().position(|f| f.collider == collider);
            return fixed.map(Solid::Fixed);
        };
        let gantry = self.gantries.iter().position(|g| g.base_handle == parent || g.slides.contains(&parent));
        gantry.map(|i| Solid::Gantry(GantryId(i)))
    }

    /// Contacts of one of rapier's bodies in the latest step.
    pub(super) fn touched(&self, of: r::RigidBodyHandle) -> ContactReport {
        let mut report = ContactReport::default();
        for &collider in self.world.bodies[of].colliders() {
            for pair in self.world.contact_pairs_with(collider) {
                if pair.total_impulse_magnitude() <= 0.0 {
                    continue;
                }
                // rapier's normals point from the first collider of a pair to the second.
                let sign = if pair.collider1 == collider { -1.0 } else { 1.0 };
                report.touching = true;
                report.impulse_N_s += from_vector(pair.total_impulse()) * sign;
                if let Some((_, deepest)) = pair.find_deepest_contact() {
                    report.max_penetration_m = report.max_penetration_m.max(-deepest.dist);
                }
            }
        }
        report
    }
}
