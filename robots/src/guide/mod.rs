//! Goals become heading, speed and depth commands.
