-- Success with its number of runs, by condition and arm. A failed run is a row too: count it apart.
SELECT condition, arm, count(*) AS runs,
       count(error) AS failed,
       count(*) FILTER (success) AS found,
       round(avg(success::INT) FILTER (error IS NULL), 3) AS share,
       round(median(error_m), 2) AS median_error_m,
       round(median(declared_s), 0) AS median_declared_s
FROM read_parquet('part-*.parquet')
GROUP BY ALL ORDER BY ALL;

-- Paired difference of two arms: the same seed under the same condition, once with each.
-- The standard error is that of the differences, not of two independent samples.
WITH pair AS (
    SELECT a.success::INT - b.success::INT AS gain,
           a.declared_s - b.declared_s AS longer_s
    FROM read_parquet('part-*.parquet') a
    JOIN read_parquet('part-*.parquet') b USING (condition, seed_index)
    WHERE a.arm = 'beta20' AND b.arm = 'beta45' AND a.error IS NULL AND b.error IS NULL)
SELECT count(*) AS pairs,
       round(avg(gain), 3) AS gain, round(stddev_samp(gain) / sqrt(count(gain)), 3) AS gain_se,
       count(longer_s) AS both_declared,
       round(avg(longer_s), 1) AS longer_s,
       round(stddev_samp(longer_s) / sqrt(count(longer_s)), 1) AS longer_se_s
FROM pair;

-- Where the wall time went, s: spin-ups paid and taken over, missions, the slowest run.
SELECT arm, count(*) AS runs,
       count(*) FILTER (spin_up_wall_s > 0) AS spin_ups_paid,
       round(sum(spin_up_wall_s), 1) AS spin_up_s,
       round(sum(mission_wall_s), 1) AS mission_s,
       round(max(spin_up_wall_s + mission_wall_s), 1) AS slowest_s
FROM read_parquet('part-*.parquet')
GROUP BY ALL ORDER BY ALL;

-- Declarations by rule and verdict. The join leaves out those of runs that have no row yet.
SELECT d.arm, d.rule, d.verdict, count(*) AS declarations, count(DISTINCT d.run) AS runs,
       round(median(d.error_m), 2) AS median_error_m
FROM read_parquet('declarations-*.parquet') d
JOIN read_parquet('part-*.parquet') r USING (run)
GROUP BY ALL ORDER BY ALL;
