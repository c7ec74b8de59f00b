"""PPO of Stable-Baselines3 on the channel: pip install 'rheotaxis-sim[sb3]'.

    python scenarios/python/examples/ppo.py [STEPS]

The reward for progress uses the truth, which is fair in training: the policy itself sees only what the vehicle's
instruments and navigation say.
"""

import sys

import numpy as np
from stable_baselines3 import PPO
from stable_baselines3.common.evaluation import evaluate_policy

from rheotaxis.sb3 import VecEnv

steps = int(sys.argv[1]) if len(sys.argv) > 1 else 200_000
options = {"limit_s": 600, "period_s": 2, "plumes": 8, "speed_m_s": (1.0, 2.0)}
training = VecEnv("uniform_channel", 32, reward="progress", searchers_per_plume=4, **options)
training.seed(1)
model = PPO("MlpPolicy", training, n_steps=256, batch_size=512, gamma=0.997, ent_coef=0.002, seed=1, verbose=1)
model.learn(steps)

test = VecEnv("uniform_channel", 8, **options)
test.seed(1001)
returns, lengths = evaluate_policy(model, test, n_eval_episodes=16, return_episode_rewards=True, warn=False)
print(f"PPO after {steps} steps: {int(np.sum(returns))} of {len(returns)} episodes reach the source")
