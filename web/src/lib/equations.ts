/** The paper's equations that help texts show: as written, as spoken, and where they stand. */

export interface Equation {
  /** `q_t` has an index, `Q^ν` a mark above; more than one sign stands in braces. */
  readonly written: string;
  /** The same for those who listen. */
  readonly spoken: string;
  readonly source: string;
}

export const EQUATIONS = {
  sparse: {
    written: 'r_t = 0 if ‖o_{t+1} − g‖ ≤ ε, else −1',
    spoken: 'The reward at t is 0 if the object is within epsilon of the goal after the step, else minus 1.',
    source: 'Eq. 1',
  },
  return: {
    written: 'R = Σ_i γ^{i−1} r_i',
    spoken: 'The return is the sum of all rewards, the i-th of them times gamma to the power i minus 1.',
    source: 'Eq. 2',
  },
  critic: {
    written: 'L(Q) = E[(Q(s_t, a_t, g) − y)^2],  y = r_t + γ Q(s_{t+1}, μ(s_{t+1}, g), g)',
    spoken:
      'The loss of the critic is the mean squared difference of Q and its target: the reward, plus gamma times Q of what the policy does next.',
    source: 'Eq. 3',
  },
  actor: {
    written: '∇_θ J = E[∇_a Q(s_t, a, g) ∇_θ μ(s_t, g)],  a = μ(s_t, g)',
    spoken: 'The actor moves its weights theta so that the value Q of its action a rises.',
    source: 'Eq. 4',
  },
  explore: {
    written: 'a_t = μ(s_t, g) + N',
    spoken: 'The action is that of the policy plus noise.',
    source: '§3.2 and §6.1',
  },
  hindsight: {
    written: 'g̃ ∼ {o_1, …, o_T},  r̃_t = R(o_{t+1}, g̃)',
    spoken: 'A new goal is drawn from where the object was in the episode, and the reward is computed anew for it.',
    source: '§3.3',
  },
  dense: {
    written: 'r_t = −‖o_{t+1} − g‖',
    spoken: 'The reward is minus the distance of the object from the goal.',
    source: 'distance-based reward, §6.2',
  },
  curriculum: {
    written: 'score = diversity + λ · nearness,  λ grows with every update',
    spoken: 'The score of a set of samples is its diversity plus lambda times its nearness to the goals; lambda grows.',
    source: 'curriculum of Fang et al., §6.2',
  },
  novelty: {
    written: 'q_t ∝ ‖f̂(s_{t+1}, g) − f(s_{t+1}, g)‖^2',
    spoken: 'The reward grows with the squared error of the learnt network f hat against the fixed network f.',
    source: 'network distillation of Burda et al., §6.2',
  },
  distance: {
    written: 'q_t = −‖w_t − u_t‖^2,  w_t ≈ I(z_t, z_{t+1}),  u_t = ν(z_t, g)',
    spoken:
      'The reward is minus the squared distance of w, what the robot made the object do, and u, what the object wanted.',
    source: 'Eq. 7',
  },
  sldr: {
    written: 'q_t = Q^ν(z_t, w_t, g) − Q^ν(z_t, u_t, g),  w_t ≈ I(z_t, z_{t+1}),  u_t = ν(z_t, g)',
    spoken:
      'The reward is the value, for the object, of w, what the robot made it do, minus that of u, what it wanted itself.',
    source: 'Eq. 8',
  },
  streams: {
    written: '∇_θ J = E[∇_a (Q_r + Σ_i Q_{q,i})(s_t, a, g) ∇_θ μ(s_t, g)]',
    spoken: 'The actor climbs the sum of the critic of the sparse reward and the critics of all further rewards.',
    source: 'Eq. 10 and 11',
  },
} as const satisfies Record<string, Equation>;

export type EquationName = keyof typeof EQUATIONS;

/** A piece of a written equation and how it stands on the line. */
export interface Piece {
  readonly text: string;
  readonly level: 'line' | 'index' | 'raised';
}

/** Cut a written equation at its indices and marks. */
export function readEquation(written: string): Piece[] {
  return written
    .split(/([_^](?:\{[^}]*\}|.))/u)
    .filter(Boolean)
    .map((part) => {
      const level = part.startsWith('_') ? 'index' : part.startsWith('^') ? 'raised' : 'line';
      return { text: level === 'line' ? part : part.slice(1).replace(/^\{|\}$/g, ''), level };
    });
}
