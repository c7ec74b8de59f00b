//! Instruments: the truth seen through noise, rate and range.
