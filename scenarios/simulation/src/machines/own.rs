//! The components of a machine, while another run has its turn in the world that runs share.

use bevy_ecs::prelude::{Entity, World};
use bevy_ecs::query::QueryState;

/// All components of one machine of a kind that a run without frames uses.
pub(crate) trait LaneComponents: Send + Sync + Sized {
    /// The same in a world.
    type Parts: bevy_ecs::query::QueryData;

    /// Takes them from a machine, which leaves its world.
    ///
    /// # Panics
    /// If it has a component that is not among them, or lacks one: a mistake in the list.
    fn take(world: &mut World, machine: Entity) -> Self;

    /// Exchanges them for those of a machine of the same kind.
    fn exchange(&mut self, parts: &mut QueryState<Self::Parts>, world: &mut World, machine: Entity);
}

/// Makes the struct of all components of a kind of machine: those that each has, those that some have, and those that
/// only runs with frames use, which stay where they are.
macro_rules! own {
    (
        $(#[$doc:meta])* $own:ident as $parts:ident with $bundle:ident {
            $($field:ident: $component:ty,)*
        } some {
            $($other:ident: $optional:ty,)*
        } shown {
            $($shown:ty,)*
        }
    ) => {
        $(#[$doc])*
        pub(crate) struct $own {
            bundle: $bundle,
            $($other: Option<$optional>,)*
        }

        /// What each of them has: taken from a world in one go.
        #[derive(bevy_ecs::bundle::Bundle)]
        struct $bundle {
            $($field: $component,)*
        }

        /// The same in a world.
        #[derive(bevy_ecs::query::QueryData)]
        #[query_data(mutable)]
        pub(crate) struct $parts {
            $($field: &'static mut $component,)*
            $($other: Option<&'static mut $optional>,)*
        }

        impl crate::machines::LaneComponents for $own {
            type Parts = $parts;

            fn take(world: &mut bevy_ecs::prelude::World, machine: bevy_ecs::prelude::Entity) -> Self {
                let mut machine = world.entity_mut(machine);
                let own = Self {
                    bundle: machine.take().expect(concat!("each has all of ", stringify!($bundle))),
                    $($other: machine.take(),)*
                };
                $(machine.remove::<$shown>();)*
                assert!(
                    machine.archetype().components().is_empty(),
                    concat!("a component of this machine is not in the list of ", stringify!($own))
                );
                machine.despawn();
                own
            }

            fn exchange(
                &mut self,
                parts: &mut bevy_ecs::query::QueryState<$parts>,
                world: &mut bevy_ecs::prelude::World,
                machine: bevy_ecs::prelude::Entity,
            ) {
                let mut here = parts.get_mut(world, machine).expect("machines stay");
                $(std::mem::swap(&mut *here.$field, &mut self.bundle.$field);)*
                $(if let (Some(here), Some(own)) = (&mut here.$other, &mut self.$other) {
                    std::mem::swap(&mut **here, own);
                })*
            }
        }
    };
}

pub(crate) use own;
