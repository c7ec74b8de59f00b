//! A hull against what is solid: nothing is passed at any legal step, and a hit is taken with the whole mass matrix.

mod hits;
mod kit;
mod passing;
